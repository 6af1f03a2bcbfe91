#include "plugins/common/object_match.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/common/matching.h"

namespace pomona {
namespace {

constexpr double kSamePlace = 0.05;  // of the picture's larger side
constexpr float kByteScale = 512;    // that of Lowe's SIFT: values beyond half of the whole length are rare

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

bool ObjectMatcher::fitsBytes() const {
  const bool has_signs = database_.kind == FeatureKind::kSurf64 || database_.kind == FeatureKind::kSurf128;
  return !has_signs;
}

cv::Mat ObjectMatcher::comparable(const cv::Mat& descriptors) const {
  return fitsBytes() ? descriptorsToBytes(descriptors, kByteScale) : descriptors;
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
    const float distance = best->distance / (fitsBytes() ? kByteScale : 1);
    matches.push_back({i, best->place.object, best->place.feature, distance, best->distance / rival});
  }
  return matches;
}

}  // namespace pomona
