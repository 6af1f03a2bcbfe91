#include "camera/triangulate.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "camera/ply.h"
#include "datasets/render.h"
#include "file_support.h"

namespace pomona {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

StereoCalibration calibration(int width = 0, int height = 0) {
  StereoCalibration c;
  c.focal_px = 500;
  c.cx_px = 3;
  c.cy_px = 1;
  c.baseline_m = 0.2;
  c.width = width;
  c.height = height;
  return c;
}

TEST(Depth, IsFocalLengthTimesBaselineOverDisparityAndOffset) {
  StereoCalibration c = calibration();
  const cv::Mat disparity = (cv::Mat_<float>(1, 6) << 10, 0.5f, kNan, 0, -5, -4);
  cv::Mat z = depthFromDisparity(disparity, c);
  EXPECT_EQ(z.type(), CV_32FC1);
  EXPECT_FLOAT_EQ(z.at<float>(0), 10);
  EXPECT_FLOAT_EQ(z.at<float>(1), 200);
  for (int x = 2; x < 6; ++x) EXPECT_TRUE(std::isnan(z.at<float>(x))) << x;
  c.doffs_px = 5;
  z = depthFromDisparity(disparity, c);
  EXPECT_FLOAT_EQ(z.at<float>(0), 100.0f / 15);
  EXPECT_FLOAT_EQ(z.at<float>(3), 20);
  EXPECT_TRUE(std::isnan(z.at<float>(4)));  // at infinity
  EXPECT_FLOAT_EQ(z.at<float>(5), 100);
}

TEST(Depth, RefusesWrongMapsAndSizes) {
  const cv::Mat disparity(2, 3, CV_32F, cv::Scalar(1));
  EXPECT_NO_THROW(depthFromDisparity(disparity, calibration(3, 2)));
  expectContains(messageOf<std::invalid_argument>([&] { depthFromDisparity(disparity, calibration(6, 4)); }),
                 "width is 6; the disparity map's is 3");
  expectContains(messageOf<std::invalid_argument>([&] { depthFromDisparity(disparity, calibration(3, 4)); }),
                 "height");
  EXPECT_THROW(depthFromDisparity(cv::Mat(2, 3, CV_16S), calibration()), std::invalid_argument);
}

TEST(Calibration, ValidationNamesFieldValueAndRange) {
  EXPECT_NO_THROW(calibration(640, 480).validate());
  const double bad_reals[] = {std::nan(""), std::numeric_limits<double>::infinity()};
  const struct {
    const char* name;
    double StereoCalibration::*field;
    bool positive;
  } reals[] = {{"focal_px", &StereoCalibration::focal_px, true},
               {"baseline_m", &StereoCalibration::baseline_m, true},
               {"cx_px", &StereoCalibration::cx_px, false},
               {"cy_px", &StereoCalibration::cy_px, false},
               {"doffs_px", &StereoCalibration::doffs_px, false}};
  for (const auto& real : reals) {
    const auto refused = [&](double value) {
      StereoCalibration c = calibration();
      c.*real.field = value;
      expectContains(messageOf<std::invalid_argument>([&] { c.validate(); }),
                     std::string(real.name) + " is ");
    };
    for (const double bad : bad_reals) refused(bad);
    if (real.positive) refused(0);
    if (real.positive) refused(-1);
  }
  for (const auto field :
       {&StereoCalibration::width, &StereoCalibration::height, &StereoCalibration::num_disparities}) {
    StereoCalibration c = calibration();
    c.*field = -1;
    expectContains(messageOf<std::invalid_argument>([&] { c.validate(); }), "is -1; allowed: 0");
  }
}

// The renderer knows the surface of every pixel; triangulating its disparity must lead back there.
TEST(Triangulate, RecoversTheRenderedPlane) {
  SceneDescription scene;
  scene.width = 64;
  scene.height = 48;
  scene.focal_px = 70;
  scene.baseline_m = 0.5;
  const cv::Vec3d center(0.3, -0.2, 4), u(1, 0.1, 0.4), v(0, 1, -0.5);
  scene.surfaces.push_back({Shape::kPlane, center, u, v, 0, {}});
  const RenderedPair pair = render(scene);
  const cv::Mat depth = depthFromDisparity(pair.left.disparity, pair.calibration);
  const cv::Vec3d normal = u.cross(v);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      const cv::Vec3d p = pointAt(x, y, depth.at<float>(y, x), pair.calibration);
      EXPECT_NEAR(normal.dot(p - center), 0, 1e-5) << x << ' ' << y;
    }
}

TEST(Ply, HoldsEveryKnownPixelInRowOrder) {
  const cv::Mat disparity = (cv::Mat_<float>(2, 2) << 10, kNan, 0, 20);
  cv::Mat colors(2, 2, CV_8UC3, cv::Scalar(1, 2, 3));
  colors.at<cv::Vec3b>(1, 1) = {200, 150, 255};
  std::istringstream file(encodePly(disparity, colors, calibration(2, 2)));
  std::string line, header;
  while (std::getline(file, line) && line != "end_header") header += line + "|";
  EXPECT_EQ(header,
            "ply|format binary_little_endian 1.0|element vertex 2|property float x|property float y|property "
            "float z|"
            "property uchar red|property uchar green|property uchar blue|");
  const float expected[2][3] = {{-0.06f, -0.02f, 10}, {-0.02f, 0, 5}};
  const unsigned char rgb[2][3] = {{3, 2, 1}, {255, 150, 200}};
  for (int i = 0; i < 2; ++i) {
    char vertex[15];
    ASSERT_TRUE(file.read(vertex, sizeof vertex));
    float xyz[3];
    std::memcpy(xyz, vertex, sizeof xyz);
    for (int axis = 0; axis < 3; ++axis) EXPECT_FLOAT_EQ(xyz[axis], expected[i][axis]) << i << ' ' << axis;
    EXPECT_EQ(std::memcmp(vertex + 12, rgb[i], 3), 0) << i;
  }
  EXPECT_EQ(file.peek(), EOF);
}

TEST(Ply, RefusesColoursThatDoNotMatch) {
  const cv::Mat disparity(2, 2, CV_32F, cv::Scalar(1));
  EXPECT_THROW(encodePly(disparity, cv::Mat(2, 3, CV_8UC3), calibration()), std::invalid_argument);
  EXPECT_THROW(encodePly(disparity, cv::Mat(2, 2, CV_8UC1), calibration()), std::invalid_argument);
}

}  // namespace
}  // namespace pomona
