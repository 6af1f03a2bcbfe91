#include "baselines/opencv_views.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "engine/input.h"
#include "pomona/evaluation.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

constexpr int kFixedPoint = cv::StereoMatcher::DISP_SCALE;

struct Margins {
  int left, right, around;
};

cv::Mat widened(const cv::Mat& image, const Margins& margins) {
  cv::Mat result;
  cv::copyMakeBorder(image, result, margins.around, margins.around, margins.left + margins.around,
                     margins.right + margins.around, cv::BORDER_REPLICATE);
  return result;
}

/// OpenCV's own gray where it has one; it cannot shift 16-bit views into 8 bits as the engine does.
cv::Mat grayOf(const cv::Mat& image, ImageView<const std::uint8_t> engine_gray) {
  cv::Mat gray;
  if (image.type() == CV_8UC3)
    cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
  else  // OpenCV only reads the memory, but has no type that says so
    gray = cv::Mat(engine_gray.height, engine_gray.width, CV_8U, const_cast<std::uint8_t*>(engine_gray.data),
                   static_cast<std::size_t>(engine_gray.stride));
  return gray;
}

}  // namespace

int roundedDisparities(const MethodOptions& options) {
  return (options.num_disparities + 15) / 16 * 16;
}

OpenCvViews::OpenCvViews(const cv::Mat& left_image, const cv::Mat& right_image, const MethodOptions& options,
                         int window_radius) {
  Options checked;
  checked.min_disparity = options.min_disparity;
  checked.num_disparities = options.num_disparities;
  checked.validation = options.post_processing.over(checked.validation);
  checked.validate();
  InputPair pair;
  pair.set(left_image, right_image, 1);
  requireRangeFits(options.min_disparity, options.num_disparities, left_image.cols);

  const Margins margins{std::max(0, options.min_disparity + roundedDisparities(options)),
                        std::max(0, -options.min_disparity), window_radius};
  left = widened(grayOf(left_image, pair.views().left), margins);
  right = widened(grayOf(right_image, pair.views().right), margins);
  const GuideView& g = pair.views().guide;
  guide = widened(cv::Mat(g.height, g.width, CV_8UC(g.channels), const_cast<std::uint8_t*>(g.data),
                          static_cast<std::size_t>(g.stride)),
                  margins);
  inside = {margins.left + margins.around, margins.around, left_image.cols, left_image.rows};
}

void setPostProcessing(cv::StereoMatcher& matcher, const MethodOptions& options) {
  const PostProcessing& post = options.post_processing;
  const float left_right_px = options.raw ? -1 : post.left_right_px.value_or(1);
  // StereoSGBM takes what is not positive for 1, so "off" is a difference that cannot be.
  constexpr int kAnyDifference = 2048;
  matcher.setDisp12MaxDiff(left_right_px < 0 ? kAnyDifference
                                             : std::max(1, static_cast<int>(std::lround(left_right_px))));
  matcher.setSpeckleWindowSize(options.raw ? 0 : post.speckle_size_px.value_or(100));
  matcher.setSpeckleRange(2);
}

cv::Ptr<cv::StereoSGBM> semiGlobalMatcher(int mode, const MethodOptions& options) {
  constexpr int kBlock = 3;
  auto matcher = cv::StereoSGBM::create(options.min_disparity, roundedDisparities(options), kBlock);
  matcher->setP1(8 * kBlock * kBlock);
  matcher->setP2(32 * kBlock * kBlock);
  matcher->setUniquenessRatio(options.raw ? 0 : 10);
  matcher->setPreFilterCap(63);
  matcher->setMode(mode);
  setPostProcessing(*matcher, options);
  return matcher;
}

MethodResult resultFromFixedPoint(const cv::Mat& fixed, const cv::Rect& inside,
                                  const MethodOptions& options) {
  const cv::Mat of_image = fixed(inside);
  MethodResult result;
  of_image.convertTo(result.disparity, CV_32F, 1.0 / kFixedPoint);
  const cv::Mat unknown = of_image < options.min_disparity * kFixedPoint;
  result.disparity.setTo(std::numeric_limits<float>::quiet_NaN(), unknown);
  result.state = cv::Mat(of_image.size(), CV_8U, cv::Scalar(static_cast<int>(PixelState::kMeasured)));
  const bool dense = options.mode == OutputMode::kDense && !options.raw;
  if (dense) fillRowsFromBackground(result.disparity);
  result.state.setTo(static_cast<int>(dense ? PixelState::kFilledBackground : PixelState::kMismatched),
                     unknown);
  return result;
}

}  // namespace pomona
