// What every method of the registry promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "baselines/method.h"
#include "datasets/named_scenes.h"
#include "pomona/evaluation.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

const RenderedPair& scene() {
  static const RenderedPair pair = render(namedScene("boxes", 5, 160, 100, 24));
  return pair;
}

MethodOptions options(OutputMode mode, bool raw = false) {
  return {.min_disparity = 0, .num_disparities = 24, .mode = mode, .raw = raw, .threads = 2};
}

class EveryMethod : public ::testing::TestWithParam<std::string> {
 protected:
  MethodResult run(const MethodOptions& o) const {
    return makeMethod(GetParam())->run(scene().left.image, scene().right.image, o);
  }
  bool isOpenCv() const { return GetParam().starts_with("opencv"); }
};

void expectConsistent(const MethodResult& result) {
  ASSERT_EQ(result.disparity.size(), scene().left.image.size());
  ASSERT_EQ(result.disparity.type(), CV_32F);
  ASSERT_EQ(result.state.size(), result.disparity.size());
  ASSERT_EQ(result.state.type(), CV_8U);
  EXPECT_GT(result.milliseconds, 0);
  for (int y = 0; y < result.disparity.rows; ++y)
    for (int x = 0; x < result.disparity.cols; ++x) {
      const float d = result.disparity.at<float>(y, x);
      const auto state = static_cast<PixelState>(result.state.at<std::uint8_t>(y, x));
      ASSERT_EQ(std::isnan(d), isMissing(state)) << x << ", " << y << ": " << name(state);
      if (result.confidence.empty()) continue;
      const float confidence = result.confidence.at<float>(y, x);
      ASSERT_TRUE(confidence >= 0 && confidence <= 1) << confidence;
      if (std::isnan(d)) {
        ASSERT_EQ(confidence, 0);
      }
    }
}

// OpenCV's != takes a NaN to be equal to itself in its vector code.
int holesIn(const cv::Mat& disparity) {
  return static_cast<int>(disparity.total()) - cv::countNonZero(disparity == disparity);
}

double badPercent(const MethodResult& result, const cv::Mat& mask) {
  return compareWithTruth(result.disparity, scene().left.disparity, mask).badPercent(1);
}

TEST_P(EveryMethod, DenseMapsAreDenseAndMostlyRight) {
  const MethodResult result = run(options(OutputMode::kDense));
  expectConsistent(result);
  EXPECT_EQ(holesIn(result.disparity), 0);
  if (GetParam() != "paper") {
    EXPECT_LT(badPercent(result, scene().left.mask), 12);
  }
}

TEST_P(EveryMethod, SparseMapsLeaveOutWhatIsWrong) {
  const MethodResult result = run(options(OutputMode::kSparse));
  expectConsistent(result);
  const DisparityErrors errors = compareWithTruth(result.disparity, scene().left.disparity);
  EXPECT_GT(errors.holes, 0);
  EXPECT_GT(errors.coveragePercent(), 50);
  EXPECT_LT(errors.wrongPercent(1), GetParam() == "paper" ? 40 : 9);
  for (int y = 0; y < result.state.rows; ++y)
    for (int x = 0; x < result.state.cols; ++x)
      ASSERT_FALSE(isFilled(static_cast<PixelState>(result.state.at<std::uint8_t>(y, x))));
}

TEST_P(EveryMethod, RawMapsHoldWholeWinners) {
  const MethodResult result = run(options(OutputMode::kDense, true));
  expectConsistent(result);
  int whole = 0, known = 0;
  for (int y = 0; y < result.disparity.rows; ++y)
    for (int x = 0; x < result.disparity.cols; ++x) {
      const float d = result.disparity.at<float>(y, x);
      known += !std::isnan(d);
      whole += d == std::round(d);
    }
  if (isOpenCv()) {
    EXPECT_GT(known, result.disparity.total() * 8 / 10);
  } else {
    EXPECT_EQ(known, static_cast<int>(result.disparity.total()));
    EXPECT_EQ(whole, known);
  }
}

TEST_P(EveryMethod, MatchesTheWholeWidth) {
  cv::Mat texture(60, 160, CV_8U);
  cv::RNG(3).fill(texture, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(texture, texture, {3, 3}, 0);
  const auto found = [&](int shift, int min_disparity) {  // share of pixels in view that get the shift
    const cv::Mat left = texture.colRange(16, 136), right = texture.colRange(16 + shift, 136 + shift);
    MethodOptions o = options(OutputMode::kDense);
    o.min_disparity = min_disparity;
    o.num_disparities = 16;
    const cv::Mat d = makeMethod(GetParam())->run(left, right, o).disparity;
    const cv::Mat inner = d(cv::Rect(std::max(0, shift), 0, 120 - std::abs(shift), 60));
    return cv::countNonZero(cv::abs(inner - shift) <= 0.5) / static_cast<double>(inner.total());
  };
  if (GetParam() == "paper") return;  // sees a quarter of the texture
  EXPECT_GT(found(7, 0), 0.97);
  EXPECT_GT(found(-5, -8), 0.97);
}

TEST_P(EveryMethod, TakesAnyTypeAndStrideOfView) {
  if (GetParam() == "paper") return;
  for (const int type : {CV_8UC1, CV_16UC3, CV_16UC1}) {
    cv::Mat views[2] = {scene().left.image, scene().right.image};
    for (cv::Mat& view : views) {
      if (CV_MAT_CN(type) == 1) cv::cvtColor(view, view, cv::COLOR_BGR2GRAY);
      view.convertTo(view, CV_MAT_DEPTH(type), CV_MAT_DEPTH(type) == CV_16U ? 16 : 1);
      cv::Mat framed(view.rows + 4, view.cols + 9, type, cv::Scalar::all(77));
      view.copyTo(framed(cv::Rect(5, 2, view.cols, view.rows)));
      view = framed(cv::Rect(5, 2, view.cols, view.rows));
    }
    const MethodResult result = makeMethod(GetParam())->run(views[0], views[1], options(OutputMode::kDense));
    EXPECT_LT(badPercent(result, scene().left.mask), 12) << cv::typeToString(type);
  }
}

TEST_P(EveryMethod, EachCheckCanBeChosen) {
  if (GetParam() == "opencv-wls") return;  // has its own
  MethodOptions none = options(OutputMode::kSparse);
  none.post_processing = {.left_right_px = -1.0f, .speckle_size_px = 0, .median_size = 0};
  const auto missing = [&](const MethodOptions& o) { return holesIn(run(o).disparity); };
  const int without = missing(none);
  MethodOptions left_right = none, speckle = none, median = none;
  left_right.post_processing.left_right_px = 0.5f;
  speckle.post_processing.speckle_size_px = 2000;
  median.post_processing.median_size = 5;
  if (GetParam() != "paper") {  // whose coarse maps hardly know differences of half a pixel
    EXPECT_GT(missing(left_right), without);
  }
  EXPECT_GT(missing(speckle), without);
  const cv::Mat sharp = run(none).disparity, smooth = run(median).disparity;
  EXPECT_EQ(cv::countNonZero((sharp != smooth) & (sharp == sharp) & (smooth == smooth)) > 0, !isOpenCv());
  median.post_processing.median_size = 4;
  EXPECT_THROW(run(median), std::invalid_argument);
}

TEST_P(EveryMethod, RefusesWhatCannotBeMatched) {
  const auto method = makeMethod(GetParam());
  const cv::Mat& left = scene().left.image;
  const MethodOptions usual = options(OutputMode::kDense);
  EXPECT_THROW(method->run(left, left.colRange(0, 100), usual), std::invalid_argument);
  EXPECT_THROW(method->run({}, {}, usual), std::invalid_argument);
  EXPECT_THROW(method->run(cv::Mat(9, 90, CV_32F), cv::Mat(9, 90, CV_32F), usual), std::invalid_argument);
  MethodOptions too_many = usual, none = usual, far = usual;
  too_many.num_disparities = 161;
  none.num_disparities = 0;
  far.min_disparity = 160;
  for (const MethodOptions& o : {too_many, none, far})
    EXPECT_THROW(method->run(left, left, o), std::invalid_argument);
}

TEST_P(EveryMethod, TakesTheSmallestViews) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(7, 1), cv::Size(1, 7)}) {
    MethodOptions o = options(OutputMode::kDense);
    o.num_disparities = 1;
    const cv::Mat view(size, CV_8UC3, cv::Scalar::all(90));
    const MethodResult result = makeMethod(GetParam())->run(view, view, o);
    EXPECT_EQ(result.disparity.size(), size);
    if (isOpenCv()) continue;  // may have nothing to fill from
    EXPECT_EQ(holesIn(result.disparity), 0) << size;
  }
}

TEST_P(EveryMethod, OneObjectServesPairAfterPair) {
  const auto method = makeMethod(GetParam());
  const MethodResult first =
      method->run(scene().left.image, scene().right.image, options(OutputMode::kSparse));
  method->run(scene().right.image, scene().left.image, options(OutputMode::kDense, true));
  const MethodResult again =
      method->run(scene().left.image, scene().right.image, options(OutputMode::kSparse));
  EXPECT_EQ(cv::countNonZero(first.state != again.state), 0);
  EXPECT_EQ(cv::countNonZero((first.disparity != again.disparity) & (first.disparity == first.disparity)), 0);
}

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const MethodInfo& method : methods()) result.emplace_back(method.name);
  return result;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryMethod, ::testing::ValuesIn(names()), [](const auto& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Registry, ListsAllMethodsByName) {
  EXPECT_EQ(names(), (std::vector<std::string>{"asw", "balanced", "fast", "ncc", "opencv-3way", "opencv-bm",
                                               "opencv-hh", "opencv-hh4", "opencv-sgbm", "opencv-wls",
                                               "paper", "quality", "ssd"}));
  for (const MethodInfo& method : methods()) EXPECT_FALSE(method.description.empty());
}

TEST(Registry, NamesWhatItKnows) {
  try {
    makeMethod("elas");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("\"elas\" is unknown; allowed: asw, balanced"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace pomona
