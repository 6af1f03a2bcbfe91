#include "camera/triangulate.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "camera/cloud_file.h"
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
  expectContains(messageOf<std::invalid_argument>([] { calibration(640, 0).validate(); }), "height is 0");
  expectContains(messageOf<std::invalid_argument>([] { calibration(0, 480).validate(); }), "height is 480");
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

// Reads a binary PCD by its own header, field by field, as the format's description has it.
struct PcdFile {
  int width = 0, height = 0;
  std::vector<std::array<float, 3>> points;
  std::vector<std::array<unsigned char, 3>> rgb;
};

PcdFile readPcd(const std::string& bytes) {
  PcdFile pcd;
  std::istringstream file(bytes);
  std::map<std::string, std::vector<std::string>> header;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    for (std::string word; words >> word;) header[key].push_back(word);
    if (key == "DATA") break;
  }
  EXPECT_EQ(header["VERSION"].at(0), "0.7");
  EXPECT_EQ(header["DATA"].at(0), "binary");
  EXPECT_EQ(header["VIEWPOINT"], (std::vector<std::string>{"0", "0", "0", "1", "0", "0", "0"}));
  pcd.width = std::stoi(header["WIDTH"].at(0));
  pcd.height = std::stoi(header["HEIGHT"].at(0));
  EXPECT_EQ(header["POINTS"].at(0), std::to_string(pcd.width * pcd.height));
  for (int i = 0; i < pcd.width * pcd.height; ++i) {
    std::array<float, 3> xyz{};
    std::array<unsigned char, 3> color{};
    for (std::size_t field = 0; field < header["FIELDS"].size(); ++field) {
      EXPECT_EQ(header["SIZE"].at(field) + header["TYPE"].at(field) + header["COUNT"].at(field), "4F1");
      unsigned char raw[4];
      EXPECT_TRUE(file.read(reinterpret_cast<char*>(raw), sizeof raw));
      const std::string& name = header["FIELDS"][field];
      if (name == "rgb")
        color = {raw[2], raw[1], raw[0]};
      else
        std::memcpy(&xyz.at(name.at(0) - 'x'), raw, sizeof raw);
    }
    pcd.points.push_back(xyz);
    pcd.rgb.push_back(color);
  }
  EXPECT_EQ(file.peek(), EOF);
  return pcd;
}

TEST(Pcd, IsOrganisedAsTheImageIs) {
  const cv::Mat disparity = (cv::Mat_<float>(2, 3) << 10, kNan, 0, 20, 40, 50);
  cv::Mat colors(2, 3, CV_8UC3, cv::Scalar(1, 2, 3));
  colors.at<cv::Vec3b>(1, 1) = {200, 150, 255};
  const PcdFile pcd = readPcd(encodePcd(disparity, colors, calibration(3, 2)));
  ASSERT_EQ(pcd.width, 3);
  ASSERT_EQ(pcd.height, 2);
  const float expected[6][3] = {{-0.06f, -0.02f, 10}, {kNan, kNan, kNan}, {kNan, kNan, kNan},
                                {-0.03f, 0, 5},       {-0.01f, 0, 2.5f},  {-0.004f, 0, 2}};
  for (int i = 0; i < 6; ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (std::isnan(expected[i][axis]))
        EXPECT_TRUE(std::isnan(pcd.points[i][axis])) << i;
      else
        EXPECT_FLOAT_EQ(pcd.points[i][axis], expected[i][axis]) << i << ' ' << axis;
  EXPECT_EQ(pcd.rgb[0], (std::array<unsigned char, 3>{3, 2, 1}));
  EXPECT_EQ(pcd.rgb[4], (std::array<unsigned char, 3>{255, 150, 200}));
}

TEST(Points, AreThoseOfPointAt) {
  constexpr int kWidth = 37, kHeight = 5;  // no multiple of a vector
  StereoCalibration c = calibration(kWidth, kHeight);
  c.doffs_px = 1.5;
  cv::Mat1f disparity(kHeight, kWidth);
  cv::RNG(3).fill(disparity, cv::RNG::UNIFORM, -3, 40);
  disparity(2, 7) = kNan;
  const cv::Mat points = pointsFromDisparity(disparity, c);
  ASSERT_EQ(points.type(), CV_32FC3);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double z = depthAt(disparity(y, x), c);
      const cv::Vec3d expected = pointAt(x, y, z, c);
      const auto& point = points.at<cv::Vec3f>(y, x);
      for (int axis = 0; axis < 3; ++axis)
        if (std::isnan(z))
          EXPECT_TRUE(std::isnan(point[axis])) << x << ' ' << y;
        else
          EXPECT_NEAR(point[axis], expected[axis], 1e-6 * z) << x << ' ' << y << ' ' << axis;
    }
}

TEST(DepthSigma, IsWhatTheDepthChangesBy) {
  StereoCalibration c = calibration();
  c.doffs_px = 2;
  const cv::Mat disparity = (cv::Mat_<float>(1, 4) << 10, 48, kNan, -3);
  const cv::Mat sigma_px = (cv::Mat_<float>(1, 4) << 0.02f, 0.1f, kNan, 0.1f);
  const cv::Mat sigma = depthSigma(disparity, sigma_px, c);
  ASSERT_EQ(sigma.type(), CV_32FC1);
  for (int x = 0; x < 2; ++x) {
    const double d = disparity.at<float>(x), s = sigma_px.at<float>(x);
    EXPECT_NEAR(sigma.at<float>(x), (depthAt(d - s, c) - depthAt(d + s, c)) / 2, 1e-5) << x;
  }
  EXPECT_TRUE(std::isnan(sigma.at<float>(2)));
  EXPECT_TRUE(std::isnan(sigma.at<float>(3)));
  EXPECT_THROW(depthSigma(disparity, cv::Mat(1, 3, CV_32F), c), std::invalid_argument);
  EXPECT_THROW(depthSigma(disparity, cv::Mat(), c), std::invalid_argument);
}

TEST(Ply, RefusesColoursThatDoNotMatch) {
  const cv::Mat disparity(2, 2, CV_32F, cv::Scalar(1));
  EXPECT_THROW(encodePly(disparity, cv::Mat(2, 3, CV_8UC3), calibration()), std::invalid_argument);
  EXPECT_THROW(encodePly(disparity, cv::Mat(2, 2, CV_8UC1), calibration()), std::invalid_argument);
  EXPECT_THROW(encodePcd(disparity, cv::Mat(2, 3, CV_8UC3), calibration()), std::invalid_argument);
}

}  // namespace
}  // namespace pomona
