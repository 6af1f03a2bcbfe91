#include "plugins/common/sift.h"

#include <algorithm>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace pomona {

cv::Mat grayOf(const cv::Mat& view) {
  if (view.channels() == 1) return view;
  cv::Mat gray;
  cv::cvtColor(view, gray, cv::COLOR_BGR2GRAY);
  return gray;
}

ViewFeatures siftFeatures(const cv::Mat& gray, const cv::Mat& mask, const SiftOptions& options) {
  constexpr int kLeastSide_px = 8, kLayers = 3;
  constexpr double kEdgeThreshold = 10, kSigma_px = 1.6;
  ViewFeatures features;
  if (std::min(gray.cols, gray.rows) < kLeastSide_px) return features;
  cv::SIFT::create(options.max_features, kLayers, options.contrast_threshold, kEdgeThreshold, kSigma_px,
                   CV_8U)
      ->detectAndCompute(gray, mask, features.keypoints, features.descriptors);
  // OpenCV doubles the picture so that pixel x lies at 2 x + 0.5, and halves the places found by that.
  constexpr float kDoublingShift_px = 0.25f;
  for (cv::KeyPoint& k : features.keypoints) k.pt -= cv::Point2f(kDoublingShift_px, kDoublingShift_px);
  return features;
}

}  // namespace pomona
