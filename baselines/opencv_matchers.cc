// OpenCV's block matcher, and its semi-global matcher in all modes.
#include <opencv2/calib3d.hpp>

#include "baselines/opencv_views.h"
#include "baselines/stopwatch.h"

namespace pomona {

std::span<const MethodInfo> openCvMethods();

namespace {

class BlockMatcher : public Method {
  MethodResult run(const cv::Mat& left, const cv::Mat& right, const MethodOptions& options) override {
    const Stopwatch watch;
    constexpr int kRadius = 4;
    const int margin = left.rows > 1 ? kRadius : kRadius + 1;  // OpenCV wants views larger than the window
    const OpenCvViews views(left, right, options, margin);
    const auto matcher = cv::StereoBM::create(roundedDisparities(options), 2 * kRadius + 1);
    matcher->setMinDisparity(options.min_disparity);
    matcher->setUniquenessRatio(options.raw ? 0 : 10);
    if (options.raw) matcher->setTextureThreshold(0);
    setPostProcessing(*matcher, options);
    cv::Mat fixed;
    matcher->compute(views.left, views.right, fixed);
    MethodResult result = resultFromFixedPoint(fixed, views.inside, options);
    result.milliseconds = watch.milliseconds();
    return result;
  }
};

template <int kMode>
class SemiGlobalMatcher : public Method {
  MethodResult run(const cv::Mat& left, const cv::Mat& right, const MethodOptions& options) override {
    const Stopwatch watch;
    const OpenCvViews views(left, right, options);
    cv::Mat fixed;
    semiGlobalMatcher(kMode, options)->compute(views.left, views.right, fixed);
    MethodResult result = resultFromFixedPoint(fixed, views.inside, options);
    result.milliseconds = watch.milliseconds();
    return result;
  }
};

template <int kMode>
std::unique_ptr<Method> semiGlobal() {
  return std::make_unique<SemiGlobalMatcher<kMode>>();
}

constexpr MethodInfo kMethods[] = {
    {"opencv-bm", "OpenCV StereoBM, 9x9 window", [] { return std::unique_ptr<Method>(new BlockMatcher); }},
    {"opencv-sgbm", "OpenCV StereoSGBM, 5 paths", semiGlobal<cv::StereoSGBM::MODE_SGBM>},
    {"opencv-3way", "OpenCV StereoSGBM MODE_SGBM_3WAY, 3 paths", semiGlobal<cv::StereoSGBM::MODE_SGBM_3WAY>},
    {"opencv-hh", "OpenCV StereoSGBM MODE_HH, 8 paths", semiGlobal<cv::StereoSGBM::MODE_HH>},
    {"opencv-hh4", "OpenCV StereoSGBM MODE_HH4, 4 paths", semiGlobal<cv::StereoSGBM::MODE_HH4>},
};

}  // namespace

std::span<const MethodInfo> openCvMethods() {
  return kMethods;
}

}  // namespace pomona
