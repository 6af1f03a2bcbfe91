// The changes that the robustness tool makes to the right view, and its tables.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <string>

#include "bench/robustness/changes.h"
#include "bench/robustness/tables.h"

namespace pomona {
namespace {

cv::Mat changedBy(const std::string& name, const cv::Mat& view) {
  for (const Change& change : changes())
    if (name == change.name) return change.apply(view);
  ADD_FAILURE() << name << " is no change";
  return view;
}

/// Waves that no 2x2 block average alters much, in three channels of different phase.
cv::Mat wavyView() {
  cv::Mat view(64, 96, CV_8UC3);
  for (int y = 0; y < view.rows; ++y)
    for (int x = 0; x < view.cols; ++x)
      for (int c = 0; c < 3; ++c)
        view.at<cv::Vec3b>(y, x)[c] =
            cv::saturate_cast<std::uint8_t>(128 + 60 * std::sin(0.2 * x + c) + 50 * std::cos(0.25 * y));
  return view;
}

TEST(Changes, KeepSizeAndTypeAndGiveTheSameBytesAgain) {
  for (const int channels : {1, 3}) {
    cv::Mat view = wavyView();
    if (channels == 1) cv::extractChannel(view, view, 0);
    const cv::Mat original = view.clone();
    for (const Change& change : changes()) {
      const cv::Mat changed = change.apply(view);
      EXPECT_EQ(changed.size(), view.size()) << change.name;
      EXPECT_EQ(changed.type(), view.type()) << change.name;
      EXPECT_EQ(cv::norm(changed, change.apply(view), cv::NORM_INF), 0) << change.name;
      EXPECT_EQ(cv::norm(changed, view, cv::NORM_INF) == 0, &change == &changes()[0]) << change.name;
    }
    EXPECT_EQ(cv::norm(view, original, cv::NORM_INF), 0);
  }
}

TEST(Changes, OfBrightnessFollowTheirCurves) {
  cv::Mat ramp(1, 256, CV_8U);
  for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
  const auto at = [&](const char* name, int i) { return int{changedBy(name, ramp).at<std::uint8_t>(i)}; };
  EXPECT_EQ(at("gain x0.7", 200), 140);
  EXPECT_EQ(at("offset +20", 200), 220);
  EXPECT_EQ(at("offset +20", 250), 255);
  EXPECT_EQ(at("gain x0.7, offset +20", 200), 160);
  EXPECT_EQ(at("gamma 1.3", 128), 104);  // 255 (128 / 255)^1.3 = 104.1
  EXPECT_EQ(at("gamma 1.3", 255), 255);
}

TEST(Changes, NoiseHasTheStatedDeviationInEachChannel) {
  const cv::Mat gray(200, 200, CV_8UC3, cv::Scalar::all(128));
  for (const int sigma : {5, 10}) {
    const cv::Mat noisy = changedBy("noise, sigma " + std::to_string(sigma), gray);
    cv::Scalar mean, deviation;
    cv::meanStdDev(noisy, mean, deviation);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(mean[c], 128, 0.2);
      EXPECT_NEAR(deviation[c], sigma, 0.03 * sigma);
    }
    std::vector<cv::Mat> channels;
    cv::split(noisy, channels);
    EXPECT_NE(cv::norm(channels[0], channels[1], cv::NORM_INF), 0);
  }
}

TEST(Changes, ShiftsMoveThePictureDown) {
  const cv::Mat view = wavyView(), whole = changedBy("one row lower", view),
                half = changedBy("half a row lower", view);
  EXPECT_EQ(cv::norm(whole.rowRange(1, 64), view.rowRange(0, 63), cv::NORM_INF), 0);
  cv::Mat middle;
  cv::addWeighted(view.rowRange(9, 50), 0.5, view.rowRange(10, 51), 0.5, 0, middle);
  EXPECT_LE(cv::norm(half.rowRange(10, 51), middle, cv::NORM_INF), 1);
}

TEST(Changes, BlurAndCompressionLoseDetail) {
  cv::Mat dot(15, 15, CV_8U, cv::Scalar(0));
  dot.at<std::uint8_t>(7, 7) = 255;
  EXPECT_NEAR(changedBy("blur, sigma 1 px", dot).at<std::uint8_t>(7, 7), 255 * 0.399 * 0.399, 1.5);
  const cv::Mat view = wavyView();
  const double error = cv::norm(changedBy("JPEG, quality 60", view), view, cv::NORM_L1) / (64 * 96 * 3);
  EXPECT_GT(error, 0.2);
  EXPECT_LT(error, 5);
}

MethodFigures figures(const std::string& name, double first_bad1, double second_bad1) {
  MethodFigures method{name, MapKind::kDense, {{"first", {}, {}}, {"second", {}, {}}}};
  for (SceneFigures& scene : method.scenes) {
    scene.all.fill(&scene == &method.scenes[0] ? first_bad1 : second_bad1);
    scene.nonoccluded = scene.all;
  }
  return method;
}

TEST(RobustnessTables, ShowRisesMediansAndWhoIsLessHurt) {
  const std::vector<ChangedFigures> all = {
      {"unchanged", {figures("ours dense", 2, 4), figures("peer dense", 5, 6)}},
      {"dust", {figures("ours dense", 3, 10), figures("peer dense", 8, 8)}}};
  const std::string tables = robustnessMarkdown(all);
  EXPECT_NE(tables.find("| unchanged | 3.00 | 5.50 |"), std::string::npos) << tables;
  EXPECT_NE(tables.find("| dust | 6.50 (+3.50) | 8.00 (+2.50) |"), std::string::npos) << tables;
  EXPECT_NE(tables.find("| dust | 3.50 | 2.50 |"), std::string::npos) << tables;  // medians of two
  EXPECT_NE(tables.find("| dust | 1 |\n"), std::string::npos) << tables;
  const std::string json = robustnessJson(all);
  EXPECT_NE(json.find("\"dust\": {"), std::string::npos);
}

}  // namespace
}  // namespace pomona
