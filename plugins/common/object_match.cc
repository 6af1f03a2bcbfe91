#include "plugins/common/object_match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "plugins/common/matching.h"

namespace pomona {
namespace {

constexpr double kSamePlace = 0.05;  // of the picture's larger side

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

struct PlacedMatch {
  ObjectMatch match;
  cv::KeyPoint in_picture, in_image;
};

struct Agreement {
  cv::Matx33d image_from_picture = cv::Matx33d::eye();
  std::vector<PlacedMatch> matches;
};

// Matches whose features are turned by nearly the same angle: those of one object are, whatever its slant, to
// within some 25 degrees (Lowe 2004 votes likewise).
std::vector<PlacedMatch> turnedAlike(const std::vector<PlacedMatch>& matches) {
  constexpr int kBins = 36, kReach = 2;
  const auto bin_of = [](const PlacedMatch& m) {
    const double turn = std::fmod(m.in_image.angle - m.in_picture.angle + 720, 360.0);
    return std::min(kBins - 1, static_cast<int>(turn * kBins / 360));
  };
  std::array<int, kBins> counts{};
  for (const PlacedMatch& m : matches)
    for (int k = -kReach; k <= kReach; ++k) ++counts[(bin_of(m) + k + kBins) % kBins];
  const int best = static_cast<int>(std::max_element(counts.begin(), counts.end()) - counts.begin());
  std::vector<PlacedMatch> alike;
  for (const PlacedMatch& m : matches) {
    const int off = std::abs(bin_of(m) - best);
    if (std::min(off, kBins - off) <= kReach) alike.push_back(m);
  }
  return alike;
}

Agreement agreementWith(const cv::Matx33d& image_from_picture, const std::vector<PlacedMatch>& matches,
                        double reach_px) {
  Agreement agreement{image_from_picture, {}};
  for (const PlacedMatch& m : matches) {
    const cv::Point2d expected = mapped(image_from_picture, m.in_picture.pt);
    if (std::hypot(expected.x - m.in_image.pt.x, expected.y - m.in_image.pt.y) <= reach_px)
      agreement.matches.push_back(m);
  }
  return agreement;
}

constexpr int kTries = 5000;
constexpr double kCertainty = 0.9999;

void placesOf(const std::vector<PlacedMatch>& matches, std::vector<cv::Point2f>& in_picture,
              std::vector<cv::Point2f>& in_image) {
  for (const PlacedMatch& m : matches) {
    in_picture.push_back(m.in_picture.pt);
    in_image.push_back(m.in_image.pt);
  }
}

Agreement homography(const std::vector<PlacedMatch>& matches, double reach_px) {
  if (matches.size() < 4) return {};
  std::vector<cv::Point2f> in_picture, in_image;
  placesOf(matches, in_picture, in_image);
  const cv::Mat h =
      cv::findHomography(in_picture, in_image, cv::RANSAC, reach_px, cv::noArray(), kTries, kCertainty);
  return h.empty() ? Agreement() : agreementWith(h, matches, reach_px);
}

// Small or distant objects show next to no perspective: a homography of their few matches bends at will.
Agreement affineFirst(const std::vector<PlacedMatch>& matches, double reach_px) {
  constexpr double kBend = 3;  // how much farther off than `reach_px` perspective may put a match
  std::vector<cv::Point2f> in_picture, in_image;
  placesOf(matches, in_picture, in_image);
  const cv::Mat a =
      cv::estimateAffine2D(in_picture, in_image, cv::noArray(), cv::RANSAC, reach_px, kTries, kCertainty);
  if (a.empty()) return {};
  const cv::Matx33d affine(a.at<double>(0, 0), a.at<double>(0, 1), a.at<double>(0, 2), a.at<double>(1, 0),
                           a.at<double>(1, 1), a.at<double>(1, 2), 0, 0, 1);
  Agreement flat = agreementWith(affine, matches, reach_px);
  Agreement bent = homography(agreementWith(affine, matches, kBend * reach_px).matches, reach_px);
  return bent.matches.size() > flat.matches.size() ? bent : flat;
}

}  // namespace

ObjectMatcher::ObjectMatcher(const ObjectDatabase& database) : database_(database) {
  for (int i = 0; i < static_cast<int>(database.objects.size()); ++i) {
    const Features& features = database.objects[i].features;
    for (int k = 0; k < features.count(); ++k) {
      const auto view = static_cast<std::size_t>(features.keypoints[k].class_id);
      if (view >= views_.size()) views_.resize(view + 1);
      views_[view].places.push_back({i, k});
      views_[view].descriptors.push_back(features.descriptors.row(k));
    }
  }
  std::erase_if(views_, [](const View& view) { return view.places.empty(); });
  for (View& view : views_) view.descriptors = comparable(view.descriptors);
}

cv::Mat ObjectMatcher::comparable(const cv::Mat& descriptors) const {
  constexpr double kScale = 512;  // that of Lowe's SIFT: values beyond half of the whole length are rare
  const bool has_signs = database_.kind == FeatureKind::kSurf64 || database_.kind == FeatureKind::kSurf128;
  return has_signs ? descriptors : descriptorsToBytes(descriptors, kScale);
}

bool ObjectMatcher::isSamePlace(const Place& a, const Place& b) const {
  if (a.object != b.object) return false;
  const KnownObject& object = database_.objects[a.object];
  const double reach_px = kSamePlace * std::max(object.size_px.width, object.size_px.height);
  const std::vector<cv::KeyPoint>& keypoints = object.features.keypoints;
  return cv::norm(keypoints[a.feature].pt - keypoints[b.feature].pt) <= reach_px;
}

std::vector<ObjectMatch> ObjectMatcher::match(const cv::Mat& descriptors) const {
  struct Candidate {
    Place place;
    float distance, rival_distance;
  };
  std::vector<std::vector<Candidate>> candidates(descriptors.rows);
  MatchOptions options;
  options.ratio = 1;
  options.mutual = false;
  const cv::Mat queries = descriptors.empty() ? descriptors : comparable(descriptors);
  for (const View& view : views_)
    for (const KeypointMatch& match : matchKeypoints(queries, view.descriptors, options))
      candidates[match.left].push_back(
          {view.places[match.right], match.distance,
           match.ratio > 0 ? match.distance / match.ratio : std::numeric_limits<float>::infinity()});
  std::vector<ObjectMatch> matches;
  for (int i = 0; i < descriptors.rows; ++i) {
    const std::vector<Candidate>& all = candidates[i];
    const auto best = std::min_element(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
      return a.distance < b.distance;
    });
    if (best == all.end()) continue;
    float rival = best->rival_distance;
    for (const Candidate& other : all)
      if (!isSamePlace(best->place, other.place)) rival = std::min(rival, other.distance);
    matches.push_back({i, best->place.object, best->place.feature, best->distance, best->distance / rival});
  }
  return matches;
}

ObjectPlace locateObject(const KnownObject& object, int object_number,
                         const std::vector<cv::KeyPoint>& keypoints, std::span<const ObjectMatch> matches,
                         const LocateOptions& options) {
  ObjectPlace place;
  if (object.features.count() == 0) {
    place.why_not = "its picture has no features to recognise it by";
    return place;
  }
  std::vector<PlacedMatch> used;
  for (const ObjectMatch& match : matches)
    if (match.object == object_number && match.ratio <= options.ratio)
      used.push_back({match, object.features.keypoints[match.feature], keypoints[match.query]});
  if (options.model == PlaceModel::kAffineFirst) used = turnedAlike(used);
  if (static_cast<int>(used.size()) < options.min_agreeing) {
    place.why_not = few(used.size(), options.min_agreeing, "features match");
    return place;
  }
  const Agreement agreement = options.model == PlaceModel::kAffineFirst
                                  ? affineFirst(used, options.reprojection_px)
                                  : homography(used, options.reprojection_px);
  for (const PlacedMatch& placed : agreement.matches) place.agreeing.push_back(placed.match);
  if (static_cast<int>(place.agreeing.size()) < options.min_agreeing) {
    place.why_not = few(place.agreeing.size(), options.min_agreeing, "matches agree on a place");
    return place;
  }
  place.image_from_picture = agreement.image_from_picture;
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
