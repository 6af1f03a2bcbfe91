// What every comparison with OpenCV's matchers shares, so that it is fair.
#pragma once

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "baselines/method.h"

namespace pomona {

/// 8-bit views for OpenCV's matchers, widened by their nearest pixels. The matchers leave a band as wide as
/// the largest disparity unmatched, and half a window at the borders: that band now lies outside the image.
struct OpenCvViews {
  cv::Mat left, right;  ///< gray
  cv::Mat guide;        ///< the left view, with its colours
  cv::Rect inside;      ///< where the image lies in the widened one

  /// Throws std::invalid_argument for a pair or a range that Pomona refuses as well.
  OpenCvViews(const cv::Mat& left_image, const cv::Mat& right_image, const MethodOptions& options,
              int window_radius = 0);
};

/// OpenCV wants multiples of 16.
int roundedDisparities(const MethodOptions& options);

/// Left-right check (1 px) and speckle removal (100 pixels, steps up to 2 px), unless the options ask for
/// others, or for raw winners.
void setPostProcessing(cv::StereoMatcher& matcher, const MethodOptions& options);

/// StereoSGBM in the given mode: blockSize 3, P1 8*9, P2 32*9, preFilterCap 63, uniquenessRatio 10, and the
/// post-processing above.
cv::Ptr<cv::StereoSGBM> semiGlobalMatcher(int mode, const MethodOptions& options);

/// The result of a matcher on widened views (CV_16S, 1/16 px), back in the image's frame. Dense maps are
/// filled by fillRowsFromBackground(). OpenCV gives neither reasons nor a confidence: what it rejected is
/// kMismatched.
MethodResult resultFromFixedPoint(const cv::Mat& fixed, const cv::Rect& inside, const MethodOptions& options);

}  // namespace pomona
