// Confidence and sigma: do they hold on rendered scenes that they were not fitted to?
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "datasets/named_scenes.h"
#include "datasets/render.h"
#include "pomona/engine.h"

namespace pomona {
namespace {

RenderedPair noisyScene(const char* name) {
  RenderedPair pair = render(namedScene(name, 77, 480, 320, 50));
  cv::RNG random(3);
  for (RenderedView* view : {&pair.left, &pair.right}) {
    cv::Mat grain(view->image.size(), CV_16SC3), noisy;
    random.fill(grain, cv::RNG::NORMAL, 0, 3);
    view->image.convertTo(noisy, CV_16S, 0.4, 60);
    cv::Mat(noisy + grain).convertTo(view->image, CV_8U);
  }
  return pair;
}

Options optionsOf(const char* preset, OutputMode mode) {
  Options o = Options::preset(preset);
  o.num_disparities = 64;
  o.mode = mode;
  return o;
}

struct Tally {
  double pixels = 0, right = 0, expected_right = 0, within_one_sigma = 0, within_two = 0, sigma = 0;

  void add(const StereoResult& r, const cv::Mat& truth, int y, int x) {
    const double error = std::abs(r.disparity.at<float>(y, x) - truth.at<float>(y, x));
    const double sigma_px = r.sigma_px.at<float>(y, x);
    ++pixels;
    right += error <= 1;
    expected_right += r.confidence.at<float>(y, x);
    within_one_sigma += error <= sigma_px;
    within_two += error <= 2 * sigma_px;
    sigma += sigma_px;
  }
};

TEST(Trust, ConfidenceAndSigmaAreCalibrated) {
  for (const char* name : {"planes", "boxes", "spheres"}) {
    const RenderedPair pair = noisyScene(name);
    for (const char* preset : {"fast", "balanced", "quality"}) {
      SCOPED_TRACE(::testing::Message() << name << ' ' << preset);
      const StereoResult r =
          computeDisparity(pair.left.image, pair.right.image, optionsOf(preset, OutputMode::kDense));
      Tally measured, filled;
      for (int y = 0; y < r.disparity.rows; ++y)
        for (int x = 0; x < r.disparity.cols; ++x)
          (isMeasured(r.stateAt(y, x)) ? measured : filled).add(r, pair.left.disparity, y, x);
      EXPECT_NEAR(measured.expected_right / measured.pixels, measured.right / measured.pixels, 0.07);
      EXPECT_GT(measured.within_one_sigma, 0.6 * measured.pixels);
      EXPECT_GT(measured.within_two, 0.9 * measured.pixels);
      EXPECT_GT(filled.sigma / filled.pixels, 1.2 * measured.sigma / measured.pixels);
      EXPECT_LT(filled.expected_right / filled.pixels, measured.expected_right / measured.pixels);
    }
  }
}

TEST(Trust, ConfidenceTellsRightFromWrong) {
  const RenderedPair pair = noisyScene("boxes");
  const StereoResult r =
      computeDisparity(pair.left.image, pair.right.image, optionsOf("balanced", OutputMode::kSparse));
  Tally sure, unsure;
  for (int y = 0; y < r.disparity.rows; ++y)
    for (int x = 0; x < r.disparity.cols; ++x) {
      if (!isMeasured(r.stateAt(y, x))) {
        EXPECT_EQ(r.confidence.at<float>(y, x), 0);
        EXPECT_TRUE(std::isnan(r.sigma_px.at<float>(y, x)));
        continue;
      }
      (r.confidence.at<float>(y, x) > 0.97f ? sure : unsure).add(r, pair.left.disparity, y, x);
    }
  ASSERT_GT(unsure.pixels, 500);
  EXPECT_GT(1 - unsure.right / unsure.pixels, 5 * (1 - sure.right / sure.pixels));
  EXPECT_GT(unsure.sigma / unsure.pixels, sure.sigma / sure.pixels);
}

// Any disparity matches as well as any other, so none may be trusted, whatever else agrees.
TEST(Trust, NothingIsCertainWhereNothingIsToBeSeen) {
  for (const int value : {0, 120, 255}) {
    const cv::Mat view(120, 200, CV_8UC3, cv::Scalar::all(value));
    for (const char* preset : {"fast", "balanced", "quality", "paper"})
      for (const OutputMode mode : {OutputMode::kSparse, OutputMode::kDense}) {
        const StereoResult r = computeDisparity(view, view, optionsOf(preset, mode));
        double highest = 0, least_sigma_px = 0;
        cv::minMaxLoc(r.confidence, nullptr, &highest);
        cv::minMaxLoc(r.sigma_px, &least_sigma_px, nullptr, nullptr, nullptr, r.sigma_px == r.sigma_px);
        EXPECT_LE(highest, 0.6) << preset << ' ' << value;
        EXPECT_GE(least_sigma_px, 3) << preset << ' ' << value;
      }
  }
}

TEST(Trust, MinConfidenceLeavesTheSurest) {
  const RenderedPair pair = noisyScene("spheres");
  Options o = optionsOf("balanced", OutputMode::kSparse);
  const StereoResult all = computeDisparity(pair.left.image, pair.right.image, o);
  o.validation.min_confidence = 0.97f;
  const StereoResult strict = computeDisparity(pair.left.image, pair.right.image, o);
  int kept = 0, dropped = 0;
  for (int y = 0; y < all.disparity.rows; ++y)
    for (int x = 0; x < all.disparity.cols; ++x) {
      const bool stays = all.confidence.at<float>(y, x) >= 0.97f;
      ASSERT_EQ(isMeasured(strict.stateAt(y, x)), stays);
      ASSERT_EQ(std::isnan(strict.disparity.at<float>(y, x)), !stays);
      const bool goes = isMeasured(all.stateAt(y, x)) && !stays;
      ASSERT_TRUE(!goes || strict.stateAt(y, x) == PixelState::kAmbiguous);
      ASSERT_TRUE(!stays || strict.disparity.at<float>(y, x) == all.disparity.at<float>(y, x));
      dropped += goes;
      kept += stays;
    }
  EXPECT_GT(kept, 10000);
  EXPECT_GT(dropped, 500);
}

}  // namespace
}  // namespace pomona
