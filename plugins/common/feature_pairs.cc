#include "plugins/common/feature_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pomona {
namespace {

// Features at one place, with several orientations or scales, are no rivals.
constexpr float kSamePlace_px = 2;

struct Best {
  int partner = -1;
  float squared = std::numeric_limits<float>::infinity();
  float rival_squared = std::numeric_limits<float>::infinity();
};

float squaredDistance(const cv::Mat& a, int i, const cv::Mat& b, int k) {
  const float *p = a.ptr<float>(i), *q = b.ptr<float>(k);
  float sums[8] = {};
  for (int n = 0; n < a.cols; n += 8)  // 64 or 128 values
    for (int lane = 0; lane < 8; ++lane) {
      const float step = p[n + lane] - q[n + lane];
      sums[lane] += step * step;
    }
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

class Pairing {
 public:
  Pairing(const Features& left, const Features& right, const PairingOptions& options)
      : left_(left), right_(right), options_(options), by_row_(right.count()) {
    std::iota(by_row_.begin(), by_row_.end(), 0);
    std::sort(by_row_.begin(), by_row_.end(), [&](int a, int b) { return rowOf(a) < rowOf(b); });
  }

  std::vector<cv::DMatch> run() const {
    std::vector<Best> of_left(left_.count()), of_right(right_.count());
    for (int i = 0; i < left_.count(); ++i) compareWithRow(i, of_left[i], of_right);
    std::vector<cv::DMatch> pairs;
    const double squared_ratio = options_.ratio * options_.ratio;
    for (int i = 0; i < left_.count(); ++i) {
      const Best& best = of_left[i];
      if (best.partner < 0 || best.squared > squared_ratio * best.rival_squared) continue;
      if (options_.mutual && of_right[best.partner].partner != i) continue;
      pairs.emplace_back(i, best.partner, std::sqrt(best.squared));
    }
    return pairs;
  }

 private:
  float rowOf(int right) const { return right_.keypoints[right].pt.y; }

  void compareWithRow(int i, Best& best, std::vector<Best>& of_right) const {
    const cv::Point2f at = left_.keypoints[i].pt;
    const auto reach = static_cast<float>(options_.max_row_offset_px);
    auto candidate = std::lower_bound(by_row_.begin(), by_row_.end(), at.y - reach,
                                      [&](int right, float row) { return rowOf(right) < row; });
    for (; candidate != by_row_.end() && rowOf(*candidate) <= at.y + reach; ++candidate) {
      const double disparity_px = at.x - right_.keypoints[*candidate].pt.x;
      if (disparity_px < options_.min_disparity_px || disparity_px > options_.max_disparity_px) continue;
      const float squared = squaredDistance(left_.descriptors, i, right_.descriptors, *candidate);
      update(best, *candidate, squared, right_.keypoints);
      update(of_right[*candidate], i, squared, left_.keypoints);
    }
  }

  static void update(Best& best, int partner, float squared, const std::vector<cv::KeyPoint>& places) {
    const bool same_place =
        best.partner >= 0 && std::abs(places[partner].pt.x - places[best.partner].pt.x) <= kSamePlace_px;
    if (squared < best.squared) {
      if (!same_place) best.rival_squared = best.squared;
      best.partner = partner;
      best.squared = squared;
    } else if (!same_place) {
      best.rival_squared = std::min(best.rival_squared, squared);
    }
  }

  const Features &left_, &right_;
  const PairingOptions& options_;
  std::vector<int> by_row_;
};

}  // namespace

std::vector<cv::DMatch> pairFeatures(const Features& left, const Features& right,
                                     const PairingOptions& options) {
  return Pairing(left, right, options).run();
}

}  // namespace pomona
