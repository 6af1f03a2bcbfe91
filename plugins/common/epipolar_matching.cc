#include "plugins/common/epipolar_matching.h"

#include <algorithm>
#include <cmath>

#include "plugins/common/combined_distance.h"

namespace pomona {
namespace {

constexpr float kSamePlace_px = 2;

bool passesRatio(int nearest, int second, float ratio) {
  return second == TwoNearest::kNone || static_cast<float>(nearest) < ratio * static_cast<float>(second);
}

// Keypoints by whole rows.
class Rows {
 public:
  explicit Rows(const std::vector<cv::KeyPoint>& keypoints) {
    for (const cv::KeyPoint& k : keypoints) first_ = std::min(first_, rowOf(k.pt.y));
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      const auto row = static_cast<std::size_t>(rowOf(keypoints[i].pt.y) - first_);
      if (row >= rows_.size()) rows_.resize(row + 1);
      rows_[row].push_back(static_cast<int>(i));
    }
  }

  /// Calls `use(number)` for all keypoints whose y lies between, and some beside.
  template <typename Use>
  void forEach(float low_y, float high_y, Use use) const {
    const int last = std::min(rowOf(high_y) - first_, static_cast<int>(rows_.size()) - 1);
    for (int row = std::max(0, rowOf(low_y) - first_); row <= last; ++row)
      for (const int i : rows_[static_cast<std::size_t>(row)]) use(i);
  }

 private:
  static int rowOf(float y) { return cvFloor(y); }

  int first_ = 0;
  std::vector<std::vector<int>> rows_;
};

struct Candidate {
  int feature, distance;
};

// Of all `candidates` the nearest; and whether it is nearer by the ratio than any other place.
int clearWinner(const std::vector<Candidate>& candidates, const ViewFeatures& view, float ratio) {
  const auto nearest = std::min_element(candidates.begin(), candidates.end(),
                                        [](auto& a, auto& b) { return a.distance < b.distance; });
  if (nearest == candidates.end()) return -1;
  const cv::Point2f place = view.keypoints[static_cast<std::size_t>(nearest->feature)].pt;
  int second = TwoNearest::kNone;
  for (const Candidate& c : candidates) {
    const cv::Point2f apart = view.keypoints[static_cast<std::size_t>(c.feature)].pt - place;
    if (apart.dot(apart) > kSamePlace_px * kSamePlace_px) second = std::min(second, c.distance);
  }
  return passesRatio(nearest->distance, second, ratio) ? nearest->feature : -1;
}

/// The left keypoint that is nearest to each right one.
class NearestLeft {
 public:
  explicit NearestLeft(std::size_t right_keypoints) : nearest_(right_keypoints, {-1, TwoNearest::kNone}) {}
  void offer(int right, Candidate left) {
    Candidate& best = nearest_[static_cast<std::size_t>(right)];
    if (left.distance < best.distance) best = left;
  }
  int of(int right) const { return nearest_[static_cast<std::size_t>(right)].feature; }

 private:
  std::vector<Candidate> nearest_;
};

}  // namespace

bool EpipolarConstraints::allow(const cv::KeyPoint& left, const cv::KeyPoint& right) const {
  const float disparity_px = left.pt.x - right.pt.x;
  if (std::abs(left.pt.y - right.pt.y) > max_row_offset_px) return false;
  if (disparity_px < min_disparity_px || disparity_px > max_disparity_px) return false;
  if (left.size > max_size_ratio * right.size || right.size > max_size_ratio * left.size) return false;
  const float turn_deg = std::abs(left.angle - right.angle);
  return std::min(turn_deg, 360 - turn_deg) <= max_turn_deg;
}

std::vector<FeatureMatch> matchAll(const ViewFeatures& left, const ViewFeatures& right,
                                   const MatchingOptions& options) {
  const std::vector<TwoNearest> nearest = findTwoNearest(left.descriptors, right.descriptors);
  std::vector<TwoNearest> back;
  if (options.mutual) back = findTwoNearest(right.descriptors, left.descriptors);
  std::vector<FeatureMatch> matches;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const TwoNearest& found = nearest[i];
    const int number = static_cast<int>(i);
    if (found.nearest < 0 || !passesRatio(found.distance, found.second_distance, options.ratio)) continue;
    const auto j = static_cast<std::size_t>(found.nearest);
    if (options.mutual && back[j].nearest != number) continue;
    if (options.constraints.allow(left.keypoints[i], right.keypoints[j]))
      matches.push_back({number, found.nearest});
  }
  return matches;
}

std::vector<FeatureMatch> matchAlongRows(const ViewFeatures& left, const ViewFeatures& right,
                                         const MatchingOptions& options) {
  const EpipolarConstraints& constraints = options.constraints;
  const Rows rows(right.keypoints);
  NearestLeft nearest_left(right.keypoints.size());
  std::vector<FeatureMatch> found;
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < left.keypoints.size(); ++i) {
    const cv::KeyPoint& here = left.keypoints[i];
    const int number = static_cast<int>(i);
    candidates.clear();
    rows.forEach(
        here.pt.y - constraints.max_row_offset_px, here.pt.y + constraints.max_row_offset_px, [&](int j) {
          if (!constraints.allow(here, right.keypoints[static_cast<std::size_t>(j)])) return;
          const int distance =
              combinedDistance(left.descriptors.ptr(number), right.descriptors.ptr(j), left.descriptors.cols);
          candidates.push_back({j, distance});
          nearest_left.offer(j, {number, distance});
        });
    const int winner = clearWinner(candidates, right, options.ratio);
    if (winner >= 0) found.push_back({number, winner});
  }
  if (options.mutual)
    std::erase_if(found, [&](const FeatureMatch& m) { return nearest_left.of(m.right) != m.left; });
  return found;
}

}  // namespace pomona
