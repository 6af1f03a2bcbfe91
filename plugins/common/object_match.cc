#include "plugins/common/object_match.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace pomona {
namespace {

constexpr double kSamePlace = 0.05;  // of the picture's larger side
constexpr int kMostNeighbors = 6;

std::string few(std::size_t count, int needed, const char* what) {
  return std::to_string(count) + " of at least " + std::to_string(needed) + " " + what;
}

std::vector<cv::Point2f> outlineOf(const cv::Matx33d& image_from_picture, cv::Size size) {
  const double right = size.width - 1, bottom = size.height - 1;
  std::vector<cv::Point2f> outline;
  for (const cv::Point2d corner : {cv::Point2d(0, 0), {right, 0}, {right, bottom}, {0, bottom}})
    outline.emplace_back(mapped(image_from_picture, corner));
  return outline;
}

// Whether the picture's corners are all in front of the camera, in their order, around a sensible area.
bool isPlausible(const cv::Matx33d& h, const std::vector<cv::Point2f>& outline, cv::Size size,
                 const LocateOptions& options) {
  const double right = size.width - 1, bottom = size.height - 1;
  for (const cv::Vec3d& corner :
       {cv::Vec3d(0, 0, 1), cv::Vec3d(right, 0, 1), cv::Vec3d(right, bottom, 1), cv::Vec3d(0, bottom, 1)})
    if ((h * corner)[2] * h(2, 2) <= 0) return false;
  constexpr bool kSigned = true;
  return cv::isContourConvex(outline) && cv::contourArea(outline, kSigned) >= options.min_area_px;
}

}  // namespace

ObjectMatcher::ObjectMatcher(const ObjectDatabase& database) : database_(database) {
  int most_views = 1;
  for (int i = 0; i < static_cast<int>(database.objects.size()); ++i) {
    const Features& features = database.objects[i].features;
    for (int k = 0; k < features.count(); ++k) {
      places_.push_back({i, k});
      most_views = std::max(most_views, features.keypoints[k].class_id + 1);
    }
    descriptors_.push_back(features.descriptors);
  }
  neighbors_ = std::min({most_views + 1, kMostNeighbors, descriptors_.rows});
}

bool ObjectMatcher::isSamePlace(const Place& a, const Place& b) const {
  if (a.object != b.object) return false;
  const KnownObject& object = database_.objects[a.object];
  const cv::KeyPoint &first = object.features.keypoints[a.feature],
                     &second = object.features.keypoints[b.feature];
  const double reach_px = kSamePlace * std::max(object.size_px.width, object.size_px.height);
  return first.class_id != second.class_id && cv::norm(first.pt - second.pt) <= reach_px;
}

std::vector<ObjectMatch> ObjectMatcher::match(const cv::Mat& descriptors) const {
  std::vector<std::vector<cv::DMatch>> nearest;
  if (!descriptors.empty())
    cv::BFMatcher(cv::NORM_L2).knnMatch(descriptors, descriptors_, nearest, neighbors_);
  std::vector<ObjectMatch> matches;
  for (const std::vector<cv::DMatch>& candidates : nearest) {
    const cv::DMatch& best = candidates.front();
    const Place& place = places_[best.trainIdx];
    // Where all neighbours show the same place, the farthest of them stands in for the unknown rival.
    const auto rival = std::find_if(candidates.begin() + 1, candidates.end(), [&](const cv::DMatch& other) {
      return !isSamePlace(place, places_[other.trainIdx]);
    });
    const float rival_distance = rival == candidates.end() ? candidates.back().distance : rival->distance;
    matches.push_back({best.queryIdx, place.object, place.feature, best.distance,
                       rival_distance > 0 ? best.distance / rival_distance : 1});
  }
  return matches;
}

ObjectPlace locateObject(const KnownObject& object, int object_number,
                         const std::vector<cv::KeyPoint>& keypoints, std::span<const ObjectMatch> matches,
                         const LocateOptions& options) {
  ObjectPlace place;
  std::vector<ObjectMatch> used;
  std::vector<cv::Point2f> in_picture, in_image;
  for (const ObjectMatch& match : matches) {
    if (match.object != object_number || match.ratio > options.ratio) continue;
    used.push_back(match);
    in_picture.push_back(object.features.keypoints[match.feature].pt);
    in_image.push_back(keypoints[match.query].pt);
  }
  if (static_cast<int>(used.size()) < options.min_agreeing) {
    place.why_not = few(used.size(), options.min_agreeing, "features match");
    return place;
  }
  constexpr int kIterations = 5000;
  constexpr double kCertainty = 0.9999;
  cv::Mat agrees;
  const cv::Mat h = cv::findHomography(in_picture, in_image, cv::RANSAC, options.reprojection_px, agrees,
                                       kIterations, kCertainty);
  for (std::size_t i = 0; i < used.size() && !h.empty(); ++i)
    if (agrees.at<std::uint8_t>(static_cast<int>(i))) place.agreeing.push_back(used[i]);
  if (static_cast<int>(place.agreeing.size()) < options.min_agreeing) {
    place.why_not = few(place.agreeing.size(), options.min_agreeing, "matches agree on a place");
    return place;
  }
  place.image_from_picture = h;
  place.outline_px = outlineOf(place.image_from_picture, object.size_px);
  if (!isPlausible(place.image_from_picture, place.outline_px, object.size_px, options)) {
    place.why_not = "the matches agree on no plausible outline";
    place.outline_px.clear();
  }
  return place;
}

cv::Point2d mapped(const cv::Matx33d& image_from_picture, const cv::Point2d& place) {
  const cv::Vec3d at = image_from_picture * cv::Vec3d(place.x, place.y, 1);
  return {at[0] / at[2], at[1] / at[2]};
}

}  // namespace pomona
