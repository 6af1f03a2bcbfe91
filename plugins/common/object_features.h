// The local features that objects are recognised by.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/common/sift.h"

namespace pomona {

/// The values are those in database files.
enum class FeatureKind : std::uint32_t {
  kSift = 1,  ///< Lowe 2004, 128 values
  kRootSift =
      2,        ///< square roots of SIFT's values after division by their sum (Arandjelovic & Zisserman 2012)
  kSurf64 = 3,  ///< Bay et al. 2008
  kSurf128 = 4,  ///< the same with sums split by sign
};

/// "sift", "root-sift", "surf-64", "surf-128".
std::string_view nameOf(FeatureKind kind);
/// Those that this build has: without SURF (POMONA_WITH_SURF=OFF) the first two only.
std::vector<FeatureKind> featureKinds();
/// Throws std::invalid_argument "features is 'x'; allowed: ..." for a name not in featureKinds().
FeatureKind featureKindOf(std::string_view name);
int descriptorLength(FeatureKind kind);

struct Features {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;  ///< CV_32F, a row of unit length per keypoint

  int count() const { return static_cast<int>(keypoints.size()); }
};

/// Finds the features of one kind. `sensitivity` divides the detector's contrast threshold: 1 as published.
class FeatureFinder {
 public:
  explicit FeatureFinder(FeatureKind kind, double sensitivity = 1);

  /// Features of `image` (CV_8U, 1 or 3 channels) where `mask` (empty, or CV_8U of its size) is not 0. Only
  /// what is near the mask's pixels is looked at, so a small mask makes it faster.
  Features find(const cv::Mat& image, const cv::Mat& mask = {}) const;

 private:
  FeatureKind kind_;
  SiftOptions sift_;
  cv::Ptr<cv::Feature2D> surf_;  // for its kinds only
};

}  // namespace pomona
