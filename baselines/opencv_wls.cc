// OpenCV's semi-global matcher, smoothed by the weighted least squares filter of ximgproc.
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/ximgproc/disparity_filter.hpp>

#include "baselines/opencv_views.h"
#include "baselines/stopwatch.h"
#include "pomona/pixel_state.h"

namespace pomona {

std::span<const MethodInfo> openCvWlsMethods();

namespace {

// The settings of OpenCV's sample.
constexpr double kLambda = 8000;
constexpr double kSigmaColor = 1.5;

class WlsMatcher : public Method {
  MethodResult run(const cv::Mat& left, const cv::Mat& right, const MethodOptions& options) override {
    const Stopwatch watch;
    const OpenCvViews views(left, right, options);
    const auto matcher = semiGlobalMatcher(cv::StereoSGBM::MODE_HH, options);
    // Creating the filter turns off the matcher's own checks: its confidence takes their place.
    const auto filter = cv::ximgproc::createDisparityWLSFilter(matcher);
    filter->setLambda(kLambda);
    filter->setSigmaColor(kSigmaColor);
    cv::Mat fixed, fixed_right, filtered;
    matcher->compute(views.left, views.right, fixed);
    cv::ximgproc::createRightMatcher(matcher)->compute(views.right, views.left, fixed_right);
    filter->filter(fixed, views.guide, filtered, fixed_right);

    MethodResult result = resultFromFixedPoint(options.raw ? fixed : filtered, views.inside, options);
    filter->getConfidenceMap()(views.inside).convertTo(result.confidence, CV_32F, 1.0 / 255);
    // Not by !=, for which OpenCV's vector code takes a NaN to be equal to itself.
    result.confidence.setTo(0, ~(result.disparity == result.disparity));
    if (!options.raw) separateMeasured(result, options.mode);
    result.milliseconds = watch.milliseconds();
    return result;
  }

  /// The filter gives every pixel a value; its confidence is 0 where left and right view disagreed.
  static void separateMeasured(MethodResult& result, OutputMode mode) {
    const cv::Mat rejected = result.confidence == 0;
    const bool dense = mode == OutputMode::kDense;
    if (!dense) result.disparity.setTo(std::numeric_limits<float>::quiet_NaN(), rejected);
    result.state.setTo(static_cast<int>(dense ? PixelState::kFilledInterpolated : PixelState::kMismatched),
                       rejected);
  }
};

constexpr MethodInfo kMethods[] = {
    {"opencv-wls", "OpenCV StereoSGBM MODE_HH and ximgproc's weighted least squares filter",
     [] { return std::unique_ptr<Method>(new WlsMatcher); }},
};

}  // namespace

std::span<const MethodInfo> openCvWlsMethods() {
  return kMethods;
}

}  // namespace pomona
