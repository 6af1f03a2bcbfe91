#include <gtest/gtest.h>

#include <cmath>

#include "plugins/common/drawing.h"
#include "plugins/common/epipolar.h"
#include "plugins/common/triangulation.h"
#include "pomona/calibration.h"

namespace pomona {
namespace {

StereoCalibration someCalibration() {
  StereoCalibration calibration;
  calibration.focal_px = 500;
  calibration.cx_px = 70;
  calibration.cy_px = 40;
  calibration.baseline_m = 0.12;
  calibration.doffs_px = 6.5;
  return calibration;
}

/// The pixel of a camera that stands `x_m` to the right of the left one.
cv::Point2f pixelOf(const cv::Vec3d& point_m, double x_m, double cx_px, const StereoCalibration& c) {
  return cv::Point2d(cx_px + c.focal_px * (point_m[0] - x_m) / point_m[2],
                     c.cy_px + c.focal_px * point_m[1] / point_m[2]);
}

const cv::Vec3d kPoints[] = {{0.1, -0.2, 1}, {-0.5, 0.3, 4}, {2, 1, 10}};

TEST(Triangulation, IsThatOfTheDenseMap) {
  const StereoCalibration calibration = someCalibration();
  const cv::Point pixel(31, 17);
  cv::Mat disparity(80, 120, CV_32F, cv::Scalar(7.25f)), sigma_px(80, 120, CV_32F, cv::Scalar(0.5f));
  const auto dense = pointsFromDisparity(disparity, calibration).at<cv::Vec3f>(pixel);
  const float dense_sigma = depthSigma(disparity, sigma_px, calibration).at<float>(pixel);
  const SparsePoint point = triangulate(calibration, pixel, cv::Point2f(pixel.x - 7.25f, pixel.y), 0.5f, 3);
  EXPECT_FLOAT_EQ(point.point_m.x, dense[0]);
  EXPECT_FLOAT_EQ(point.point_m.y, dense[1]);
  EXPECT_FLOAT_EQ(point.point_m.z, dense[2]);
  EXPECT_FLOAT_EQ(point.sigma_z_m, dense_sigma);
  EXPECT_EQ(point.disparity_px, 7.25f);
  EXPECT_EQ(point.object, 3);
}

TEST(Triangulation, FindsThePointThatBothCamerasSee) {
  const StereoCalibration c = someCalibration();
  for (const cv::Vec3d& truth : kPoints) {
    const SparsePoint point = triangulate(c, pixelOf(truth, 0, c.cx_px, c),
                                          pixelOf(truth, c.baseline_m, c.cx_px + c.doffs_px, c), 1);
    EXPECT_NEAR(cv::norm(cv::Vec3d(point.point_m.x, point.point_m.y, point.point_m.z) - truth), 0,
                1e-4 * truth[2]);
  }
}

TEST(Triangulation, KnowsNoPointAtInfinityOrBeyond) {
  const StereoCalibration c = someCalibration();
  for (const float disparity_px : {-6.5f, -7.0f}) {
    const SparsePoint point = triangulate(c, {50, 50}, {50 - disparity_px, 50}, 1);
    EXPECT_TRUE(std::isnan(point.point_m.z));
    EXPECT_TRUE(std::isnan(point.sigma_z_m));
  }
}

TEST(Triangulation, TurnsPointsIntoDistanceAndBearing) {
  EXPECT_DOUBLE_EQ(distanceOf({2, 3, 6}), 7);
  EXPECT_DOUBLE_EQ(bearingOf({1, 5, 1}), 45);
  EXPECT_DOUBLE_EQ(bearingOf({-1, 5, 1}), -45);
}

TEST(Epipolar, EveryPointObeys) {
  const StereoCalibration c = someCalibration();
  const cv::Matx33d essential = essentialMatrix(c), fundamental = fundamentalMatrix(c);
  for (const cv::Vec3d& point : kPoints) {
    const cv::Vec3d in_right = point - cv::Vec3d(c.baseline_m, 0, 0);
    EXPECT_NEAR((point / point[2]).dot(essential * (in_right / in_right[2])), 0, 1e-12);
    const cv::Point2f left = pixelOf(point, 0, c.cx_px, c);
    const cv::Point2f right = pixelOf(point, c.baseline_m, c.cx_px + c.doffs_px, c);
    EXPECT_NEAR(epipolarDistance(fundamental, left, right), 0, 1e-4);
    EXPECT_NEAR(epipolarDistance(fundamental, left, right + cv::Point2f(9, 2.5f)), 2.5, 1e-4);
  }
  EXPECT_GT(cv::norm(essential), 0);
}

/// How far from gray the pixel is.
int colorfulness(const cv::Mat& picture, cv::Point at) {
  const auto& bgr = picture.at<cv::Vec3b>(at);
  return std::max({bgr[0], bgr[1], bgr[2]}) - std::min({bgr[0], bgr[1], bgr[2]});
}

TEST(Drawing, ShowsNearPointsWarmAndFarOnesCold) {
  SparseResult result;
  result.points.resize(2);
  result.points[0].left_px = {30, 40};
  result.points[0].disparity_px = 20;
  result.points[1].left_px = {90, 40};
  result.points[1].disparity_px = 3;
  for (const int type : {CV_8UC1, CV_8UC3}) {
    const cv::Mat picture = drawSparse(cv::Mat(100, 200, type, cv::Scalar::all(80)), result);
    ASSERT_EQ(picture.type(), CV_8UC3);
    EXPECT_EQ(picture.at<cv::Vec3b>(10, 10), cv::Vec3b(40, 40, 40));
    EXPECT_GT(colorfulness(picture, {30, 40}), 50);
    EXPECT_GT(picture.at<cv::Vec3b>(40, 30)[2], picture.at<cv::Vec3b>(40, 30)[0]) << "red";
    EXPECT_GT(picture.at<cv::Vec3b>(40, 90)[0], picture.at<cv::Vec3b>(40, 90)[2]) << "blue";
  }
}

TEST(Drawing, OutlinesWhatWasFoundAndNothingElse) {
  const cv::Mat left(100, 200, CV_8UC1, cv::Scalar(80));
  SparseResult result;
  result.objects.resize(1);
  result.objects[0].label = "LOGO";
  result.objects[0].outline_px = {{50, 40}, {120, 40}, {120, 80}, {50, 80}};
  result.objects[0].distance_m = 5.5;
  const auto brightness = [](const cv::Mat& picture, cv::Point at) { return picture.at<cv::Vec3b>(at)[1]; };
  const cv::Mat picture = drawSparse(left, result);
  EXPECT_GT(brightness(picture, {85, 80}), 200);
  int letters = 0;
  for (int y = 20; y < 37; ++y)
    for (int x = 50; x < 150; ++x) letters += brightness(picture, {x, y}) > 150;
  EXPECT_GT(letters, 100);

  result.objects[0].outline_px.clear();
  result.objects[0].box_px = {50, 40, 70, 40};
  EXPECT_GT(brightness(drawSparse(left, result), {85, 80}), 200);
  result.objects[0].why_not = "hidden";
  EXPECT_EQ(brightness(drawSparse(left, result), {85, 80}), 40);
}

}  // namespace
}  // namespace pomona
