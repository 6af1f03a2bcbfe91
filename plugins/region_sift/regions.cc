#include "plugins/region_sift/regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace pomona {
namespace {

std::array<cv::Rect, 7> subImagesOf(cv::Size view, double far_share) {
  const int far = cvRound(far_share * view.height), middle = far + (view.height - far) / 2;
  const std::array<int, 4> x{0, view.width / 3, 2 * view.width / 3, view.width};
  const std::array<int, 3> y{far, middle, view.height};
  std::array<cv::Rect, 7> images;
  images[0] = {0, 0, view.width, far};
  for (std::size_t row = 0; row < 2; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      images[1 + 3 * row + column] =
          cv::Rect(cv::Point(x[column], y[row]), cv::Point(x[column + 1], y[row + 1]));
  return images;
}

// Keypoints by the pixel they lie in, to find those at the same place.
class Places {
 public:
  /// The keypoint among `kept` that `k` repeats, or -1.
  int repeated(const cv::KeyPoint& k, const std::vector<cv::KeyPoint>& kept) const {
    constexpr float kSamePlace_px = 0.5f, kSameSize = 1.2f, kSameAngle_deg = 20;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto [begin, end] = numbers_.equal_range({cvRound(k.pt.x) + dx, cvRound(k.pt.y) + dy});
        for (auto it = begin; it != end; ++it) {
          const cv::KeyPoint& other = kept[static_cast<std::size_t>(it->second)];
          const float turn_deg = std::abs(k.angle - other.angle);
          if (cv::norm(k.pt - other.pt) <= kSamePlace_px && k.size <= kSameSize * other.size &&
              other.size <= kSameSize * k.size && std::min(turn_deg, 360 - turn_deg) <= kSameAngle_deg)
            return it->second;
        }
      }
    return -1;
  }
  void add(const cv::KeyPoint& k, int number) {
    numbers_.emplace(std::pair{cvRound(k.pt.x), cvRound(k.pt.y)}, number);
  }

 private:
  std::multimap<std::pair<int, int>, int> numbers_;
};

// Adds what `more` has and `all` has not; takes over what it has stronger.
void merge(ViewFeatures& all, const ViewFeatures& more) {
  if (all.keypoints.empty()) {
    all = more;
    return;
  }
  Places places;
  for (std::size_t i = 0; i < all.keypoints.size(); ++i) places.add(all.keypoints[i], static_cast<int>(i));
  for (std::size_t i = 0; i < more.keypoints.size(); ++i) {
    const cv::KeyPoint& k = more.keypoints[i];
    const cv::Mat descriptor = more.descriptors.row(static_cast<int>(i));
    const int twin = places.repeated(k, all.keypoints);
    if (twin < 0) {
      all.keypoints.push_back(k);
      all.descriptors.push_back(descriptor);
    } else if (k.response > all.keypoints[static_cast<std::size_t>(twin)].response) {
      all.keypoints[static_cast<std::size_t>(twin)] = k;
      descriptor.copyTo(all.descriptors.row(twin));
    }
  }
}

cv::Mat equalised(const cv::Mat& gray) {
  cv::Mat flat;
  cv::equalizeHist(gray, flat);
  return flat;
}

// Those of `part`, whose upper left corner lies at `origin` of the view, in pixels of the view.
ViewFeatures featuresAtScale(const cv::Mat& part, const cv::Mat& mask, const cv::Point2f& origin,
                             const RegionOptions& options) {
  cv::Mat scaled = part, scaled_mask = mask;
  if (options.scale < 1) {
    const cv::Size size(std::max(1, cvRound(options.scale * part.cols)),
                        std::max(1, cvRound(options.scale * part.rows)));
    cv::resize(part, scaled, size, 0, 0, cv::INTER_AREA);
    if (!mask.empty()) cv::resize(mask, scaled_mask, size, 0, 0, cv::INTER_NEAREST);
  }
  ViewFeatures features = siftFeatures(scaled, scaled_mask, options.sift);
  const float x = static_cast<float>(part.cols) / static_cast<float>(scaled.cols);
  const float y = static_cast<float>(part.rows) / static_cast<float>(scaled.rows);
  for (cv::KeyPoint& k : features.keypoints) {
    k.pt = origin + cv::Point2f((k.pt.x + 0.5f) * x - 0.5f, (k.pt.y + 0.5f) * y - 0.5f);
    k.size *= x;
  }
  return features;
}

}  // namespace

std::vector<cv::Rect> regionsOf(cv::Size view, const RegionOptions& options) {
  const std::array<cv::Rect, 7> s = subImagesOf(view, options.far_share);
  std::vector<cv::Rect> regions{s[1] | s[4], s[2] | s[5], s[3] | s[6], s[4] | s[6]};
  if (options.far_region) regions.push_back(s[0]);
  if (options.whole_region) regions.push_back(s[0] | s[6]);
  std::erase_if(regions, [](const cv::Rect& r) { return r.empty(); });
  if (!options.joined) return regions;
  cv::Rect all;
  for (const cv::Rect& region : regions) all |= region;
  return {all};
}

ViewFeatures regionFeatures(const cv::Mat& gray, const cv::Mat& mask, const RegionOptions& options) {
  ViewFeatures all;
  for (const cv::Rect& region : regionsOf(gray.size(), options)) {
    const cv::Mat part = options.equalise ? equalised(gray(region)) : gray(region);
    const cv::Mat part_mask = mask.empty() ? mask : mask(region);
    merge(all, featuresAtScale(part, part_mask, region.tl(), options));
  }
  return all;
}

}  // namespace pomona
