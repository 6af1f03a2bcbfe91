// Rigs: what is refused, the rectified form, and the files of every format.
#include "pomona/rig.h"

#include <cmath>
#include <opencv2/calib3d.hpp>

#include "file_support.h"

namespace pomona {
namespace {

// A converging rig with lenses, as a calibration would give it.
StereoRig someRig() {
  StereoRig rig;
  rig.left = {1280,
              720,
              1056.6,
              1057.1,
              640.5,
              361.25,
              DistortionModel::kPolynomial,
              {-0.17, 0.027, 0.0004, -0.0003, 0.001}};
  rig.right = {1280,
               720,
               1055.2,
               1055.9,
               636.75,
               358.5,
               DistortionModel::kPolynomial,
               {-0.16, 0.021, -0.0002, 0.0005, 0.002}};
  cv::Rodrigues(cv::Vec3d(0.004, 0.012, -0.006), rig.right_from_left_rotation);
  rig.right_from_left_m = {-0.1199, 0.0004, 0.0011};
  return rig;
}

void expectNear(const cv::Matx33d& a, const cv::Matx33d& b, double tolerance) {
  EXPECT_LE(cv::norm(a, b, cv::NORM_INF), tolerance) << a << "\n" << b;
}

void expectSameCamera(const CameraModel& a, const CameraModel& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.matrix(), b.matrix());
  EXPECT_EQ(a.distortion_model, b.distortion_model);
  EXPECT_EQ(a.distortion, b.distortion);
}

void expectSameRectification(const Rectification& a, const Rectification& b, double tolerance) {
  expectNear(a.left_rotation, b.left_rotation, tolerance);
  expectNear(a.right_rotation, b.right_rotation, tolerance);
  EXPECT_NEAR(a.calibration.focal_px, b.calibration.focal_px, tolerance);
  EXPECT_NEAR(a.calibration.cx_px, b.calibration.cx_px, tolerance);
  EXPECT_NEAR(a.calibration.cy_px, b.calibration.cy_px, tolerance);
  EXPECT_NEAR(a.calibration.doffs_px, b.calibration.doffs_px, tolerance);
  EXPECT_NEAR(a.calibration.baseline_m, b.calibration.baseline_m, tolerance);
  EXPECT_EQ(a.calibration.width, b.calibration.width);
  EXPECT_EQ(a.calibration.height, b.calibration.height);
}

// Where a point of the left camera's frame appears in both rectified views, by the definition.
std::pair<cv::Vec2d, cv::Vec2d> rectifiedImages(const StereoRig& rig, const Rectification& r,
                                                const cv::Vec3d& x) {
  const cv::Vec3d left = r.left_rotation * x;
  const cv::Vec3d right = r.right_rotation * (rig.right_from_left_rotation * x + rig.right_from_left_m);
  const StereoCalibration& c = r.calibration;
  return {
      {c.focal_px * left[0] / left[2] + c.cx_px, c.focal_px * left[1] / left[2] + c.cy_px},
      {c.focal_px * right[0] / right[2] + c.cx_px + c.doffs_px, c.focal_px * right[1] / right[2] + c.cy_px}};
}

TEST(Rig, RectificationAlignsRowsAndGivesDepth) {
  const StereoRig rig = someRig();
  const Rectification r = rectificationOf(rig);
  EXPECT_NEAR(r.calibration.baseline_m, rig.baselineM(), 1e-9);
  EXPECT_EQ(r.calibration.width, 1280);
  for (const cv::Vec3d& x : {cv::Vec3d(0.1, -0.2, 0.8), cv::Vec3d(-0.4, 0.3, 1.9), cv::Vec3d(0, 0, 5)}) {
    const auto [left, right] = rectifiedImages(rig, r, x);
    EXPECT_NEAR(left[1], right[1], 1e-6);
    const double depth_m = (r.left_rotation * x)[2];
    EXPECT_NEAR(
        r.calibration.focal_px * r.calibration.baseline_m / (left[0] - right[0] + r.calibration.doffs_px),
        depth_m, 1e-9);
  }
}

TEST(Rig, RectifiedRigIsItsCalibration) {
  const StereoCalibration c{1000, 300, 200, 0.1, 12.5, 640, 480, 64};
  StereoRig rig = rigOf(c);
  EXPECT_TRUE(rig.isRectified());
  rig.rectification.reset();
  expectSameRectification(rectificationOf(rig), {.calibration = c}, 1e-12);
  for (auto change : std::initializer_list<void (*)(StereoRig&)>{
           [](StereoRig& r) { r.left.distortion[0] = 0.01; }, [](StereoRig& r) { r.right.cy_px += 1; },
           [](StereoRig& r) { r.right.fy_px += 1; }, [](StereoRig& r) { r.right_from_left_m[1] = 0.001; }}) {
    StereoRig changed = rig;
    change(changed);
    EXPECT_FALSE(changed.isRectified());
  }
  EXPECT_FALSE(someRig().isRectified());
}

TEST(Rig, RefusesWhatCannotBe) {
  const double nan = std::nan("");
  const struct {
    std::function<void(StereoRig&)> change;
    const char* part;
  } cases[] = {
      {[](StereoRig& r) { r.left.fx_px = -1; }, "left fx is -1"},
      {[&](StereoRig& r) { r.right.fy_px = nan; }, "right fy is nan"},
      {[](StereoRig& r) { r.right.fy_px = 5; }, "right fx / fy"},
      {[&](StereoRig& r) { r.left.cx_px = nan; }, "left cx is nan"},
      {[](StereoRig& r) { r.left.cy_px = 5000; }, "left cy is 5000"},
      {[&](StereoRig& r) { r.left.distortion[3] = nan; }, "left distortion[3] is nan"},
      {[](StereoRig& r) { r.left.width = -2; }, "left width is -2"},
      {[](StereoRig& r) { r.right.width = 640; }, "right size is 640x720"},
      {[](StereoRig& r) { r.left.height = r.right.height = 0; }, "left size is 1280x0"},
      {[](StereoRig& r) { r.left.width = r.right.width = 10; }, "left cx is 640.5"},
      {[](StereoRig& r) { r.rectification = rectificationOf(r), r.rectification->calibration.width = 10; },
       "left rectified cx is "},
      {[](StereoRig& r) {
         r.rectification = rectificationOf(r), r.rectification->calibration.doffs_px = 1e5;
       },
       "right rectified cx is "},
      {[](StereoRig& r) { r.right.distortion_model = DistortionModel::kFisheye; }, "distortion model"},
      {[](StereoRig& r) { r.right_from_left_rotation(0, 1) = 0.1; }, "R is"},
      {[](StereoRig& r) { r.right_from_left_rotation = -cv::Matx33d::eye(); }, "not a reflection"},
      {[](StereoRig& r) { r.right_from_left_rotation = {0, -1, 0, 1, 0, 0, 0, 0, 1}; }, "45 degrees"},
      {[](StereoRig& r) { r.right_from_left_m = {}; }, "T is [0, 0, 0]"},
      {[&](StereoRig& r) { r.right_from_left_m[2] = nan; }, "T is"},
      {[](StereoRig& r) {
         r.right_from_left_m = {-0.01, -0.12, 0};
       },
       "one above the other"},
      {[](StereoRig& r) {
         r.right_from_left_m = {-0.01, 0, 0.12};
       },
       "one behind the other"},
      {[](StereoRig& r) { r.right_from_left_m *= -1; }, "left and right are exchanged"},
      {[](StereoRig& r) { r.rectification = rectificationOf(r), r.right_from_left_m *= 1000; }, "mix units"},
      {[](StereoRig& r) {
         r.rectification = rectificationOf(r), r.right_from_left_m = {-0.1, 0.0663, 0};
       },
       "two rigs"},
  };
  for (const auto& c : cases) {
    StereoRig rig = someRig();
    c.change(rig);
    expectContains(messageOf<std::invalid_argument>([&] { rig.validate(); }), c.part);
  }
  StereoRig sizeless = someRig();
  sizeless.left.width = sizeless.left.height = sizeless.right.width = sizeless.right.height = 0;
  EXPECT_NO_THROW(sizeless.validate());
  expectContains(messageOf<std::invalid_argument>([&] { rectificationOf(sizeless); }), "width is 0");
}

class RigFile : public testing::Test {
 protected:
  std::string put(const std::string& leaf, const std::string& text) {
    return pomona::put(folder_ / leaf, text);
  }
  TemporaryFolder folder_;
};

TEST_F(RigFile, OwnFormatKeepsEveryBit) {
  StereoRig rigs[] = {someRig(), someRig(), someRig(), rigOf({1000, 300, 200, 0.1, 12.5, 640, 480, 64})};
  rigs[1].rectification = rectificationOf(rigs[1]);
  rigs[2].left.distortion = rigs[2].right.distortion = {0.01, -0.002, 0.0003, 0.0001};
  rigs[2].left.distortion_model = rigs[2].right.distortion_model = DistortionModel::kFisheye;
  for (const StereoRig& rig : rigs) {
    writeRig(folder_ / "rig.yml", rig);
    const StereoRig back = readRig(folder_ / "rig.yml");
    expectSameCamera(back.left, rig.left);
    expectSameCamera(back.right, rig.right);
    EXPECT_EQ(back.right_from_left_rotation, rig.right_from_left_rotation);
    EXPECT_EQ(back.right_from_left_m, rig.right_from_left_m);
    ASSERT_EQ(back.rectification.has_value(), rig.rectification.has_value());
    if (!rig.rectification) continue;
    expectSameRectification(*back.rectification, *rig.rectification, 1e-9);
    EXPECT_EQ(back.rectification->calibration.num_disparities,
              rig.rectification->calibration.num_disparities);
  }
}

TEST_F(RigFile, RosStatesASize) {
  const StereoRig sizeless = rigOf({1000, 300, 200, 0.1, 0, 0, 0, 0});
  expectContains(
      messageOf<std::invalid_argument>([&] { writeRig(folder_ / "ros", sizeless, RigFormat::kRos); }),
      "size is unknown");
  EXPECT_EQ(folder_.fileCount(), 0);
}

TEST_F(RigFile, RosKeepsTheRectification) {
  StereoRig rig = someRig();
  rig.left.distortion[6] = 0.003;  // one rational, one plumb_bob
  writeRig(folder_ / "ros", rig, RigFormat::kRos);
  for (const StereoRig& back :
       {readRig(folder_ / "ros"), readRigPair(folder_ / "ros/left.yaml", folder_ / "ros/right.yaml")}) {
    expectSameCamera(back.left, rig.left);
    expectSameCamera(back.right, rig.right);
    expectNear(back.right_from_left_rotation, rig.right_from_left_rotation, 1e-9);
    EXPECT_LE(cv::norm(back.right_from_left_m, rig.right_from_left_m), 1e-9);
    ASSERT_TRUE(back.rectification);
    expectSameRectification(*back.rectification, rectificationOf(rig), 1e-9);
  }
  expectContains(messageOf([&] { readRigPair(folder_ / "ros/right.yaml", folder_ / "ros/left.yaml"); }),
                 "exchanged");
  expectContains(messageOf([&] { readRig(folder_ / "ros/left.yaml"); }), "needs the right camera's");
  expectContains(messageOf([&] { readRigPair(folder_ / "ros/left.yaml", folder_ / "ros/left.yaml"); }),
                 "not calibrated as a pair");
}

// camera_info as `rostopic echo` prints it, and with ROS keys in OpenCV's syntax.
TEST_F(RigFile, RosInOtherSpellings) {
  const auto echo = [](const char* offset) {
    return std::string(
               "height: 480\nwidth: 640\ndistortion_model: \"plumb_bob\"\nD: [-0.1, 0.01, 0, 0, 0]\n") +
           "K: [500, 0, 320, 0, 501, 240, 0, 0, 1]\nR: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n" + "P: [490, 0, 318, " +
           offset + ", 0, 490, 238, 0, 0, 0, 1, 0]\n";
  };
  const auto hybrid = [](const char* offset) {
    return std::string("%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\n") +
           "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n" +
           "   data: [ 500., 0., 320., 0., 501., 240., 0., 0., 1. ]\n" +
           "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n" +
           "   data: [ -1.0e-01, 1.0e-02, 0., 0., 0. ]\n" +
           "rectification_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n" +
           "   data: [ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]\n" +
           "projection_matrix: !!opencv-matrix\n   rows: 3\n   cols: 4\n   dt: d\n" +
           "   data: [ 490., 0., 318., " + offset + ",\n       0., 490., 238., 0., 0., 0., 1., 0. ]\n";
  };
  for (const auto& spelling :
       {std::function<std::string(const char*)>(echo), std::function<std::string(const char*)>(hybrid)}) {
    const StereoRig rig = readRigPair(put("l.yaml", spelling("0")), put("r.yaml", spelling("-58.8")));
    EXPECT_EQ(rig.left.fy_px, 501);
    EXPECT_EQ(rig.left.distortion[1], 0.01);
    EXPECT_NEAR(rig.right_from_left_m[0], -0.12, 1e-12);
    EXPECT_EQ(rig.rectification->calibration.focal_px, 490);
    // Millimetres, which ROS does not allow, and which cannot go unnoticed.
    put("r.yaml", spelling("-58800"));
    expectContains(messageOf([&] { readRigPair(folder_ / "l.yaml", folder_ / "r.yaml"); }),
                   "baseline is 120 m");
    EXPECT_NEAR(readRigPair(folder_ / "l.yaml", folder_ / "r.yaml", {.unit_m = 0.001}).baselineM(), 0.12,
                1e-12);
  }
}

TEST_F(RigFile, OpenCvPairOfFilesWithoutSizeOrUnit) {
  const std::string intrinsics =
      "%YAML:1.0\nM1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
      "   data: [ 5.348e+02, 0., 3.3568e+02, 0., 5.348e+02, 2.4e+02, 0., 0., 1. ]\n"
      "D1: !!opencv-matrix\n   rows: 1\n   cols: 4\n   dt: d\n   data: [ 0.29, -1.03, 0., 0.01 ]\n"
      "M2: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
      "   data: [ 5.348e+02, 0., 3.34e+02, 0., 5.348e+02, 2.42e+02, 0., 0., 1. ]\n"
      "D2: !!opencv-matrix\n   rows: 1\n   cols: 14\n   dt: d\n"
      "   data: [ -0.16, -0.11, 0., 0., 0.02, 0, 0, 0, 0, 0, 0, 0, 0, 0 ]\n";
  const std::string extrinsics =
      "%YAML:1.0\nR: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 1, 0, 0, 0, 1, 0, 0, 0, 1 "
      "]\n"
      "T: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n   data: [ -83.2, 1., 0. ]\n";
  put("in.yml", intrinsics);
  put("ex.yml", extrinsics);
  expectContains(messageOf([&] { readRigPair(folder_ / "in.yml", folder_ / "ex.yml"); }), "baseline is 83.2");
  expectContains(messageOf([&] { readRigPair(folder_ / "in.yml", folder_ / "ex.yml", {.unit_m = 1e-6}); }),
                 "in units of 1e-06 m, as asked for");
  const StereoRig rig = readRigPair(folder_ / "in.yml", folder_ / "ex.yml", {.unit_m = 1e-3});
  EXPECT_NEAR(rig.right_from_left_m[0], -0.0832, 1e-12);
  EXPECT_EQ(rig.left.width, 0);
  EXPECT_EQ(rig.left.distortion[3], 0.01);
  EXPECT_EQ(rig.right.distortion[4], 0.02);
  EXPECT_NEAR(readRig(put("one.yml", intrinsics + extrinsics.substr(10) + "length_unit: mm\n")).baselineM(),
              std::hypot(0.0832, 0.001), 1e-12);

  const std::string size = "length_unit: mm\nimage_height: 960\nimage_width: ";
  put("in.yml", intrinsics + size + "1280\n");
  put("ex.yml", extrinsics + size + "640\n");
  expectContains(messageOf([&] { readRigPair(folder_ / "in.yml", folder_ / "ex.yml"); }),
                 "image_width is '640'; allowed: that of the intrinsics, 1280");
  put("ex.yml", extrinsics + size + "1280\n");
  EXPECT_EQ(readRigPair(folder_ / "in.yml", folder_ / "ex.yml").right.width, 1280);
}

const std::string kKalibr =
    "cam0:\n  cam_overlaps: [1]\n  camera_model: pinhole\n  distortion_coeffs: [-0.28, 0.07, 0.0002, "
    "0.00002]\n"
    "  distortion_model: radtan\n  intrinsics: [458.6, 457.3, 367.2, 248.4]\n  resolution: [752, 480]\n"
    "cam1:\n  T_cn_cnm1:\n  - [1.0, 0.0, 0.0, -0.11]\n  - [0.0, 1.0, 0.0, 0.0004]\n  - [0.0, 0.0, 1.0, "
    "-0.0008]\n"
    "  - [0.0, 0.0, 0.0, 1.0]\n  camera_model: pinhole\n"
    "  distortion_coeffs: [-0.27, 0.06, -0.0001, 0.00003]\n  distortion_model: radtan\n"
    "  intrinsics: [457.6, 456.1, 379.9, 255.2]\n  resolution: [752, 480]\n";

TEST_F(RigFile, KalibrInBothDirections) {
  const StereoRig rig = readRig(put("camchain.yaml", kKalibr));
  EXPECT_EQ(rig.left.fx_px, 458.6);
  EXPECT_EQ(rig.right.cy_px, 255.2);
  EXPECT_EQ(rig.left.distortion[0], -0.28);
  EXPECT_EQ(rig.right_from_left_m, cv::Vec3d(-0.11, 0.0004, -0.0008));
  EXPECT_FALSE(rig.rectification);
  EXPECT_NEAR(rectificationOf(rig).calibration.baseline_m, rig.baselineM(), 1e-9);

  // cam0 on the right: refused, and accepted when said so.
  std::string mirrored = kKalibr;
  mirrored.replace(mirrored.find("-0.11]"), 6, "0.11]");
  put("camchain.yaml", mirrored);
  expectContains(messageOf([&] { readRig(folder_ / "camchain.yaml"); }), "exchanged");
  const StereoRig swapped = readRig(folder_ / "camchain.yaml", {.left_camera = 1, .right_camera = 0});
  EXPECT_EQ(swapped.left.fx_px, 457.6);
  EXPECT_LE(cv::norm(swapped.right_from_left_m, cv::Vec3d(-0.11, -0.0004, 0.0008)), 1e-12);
}

TEST_F(RigFile, MiddleburyIsRectified) {
  const StereoRig rig = readRig(put("calib.txt",
                                    "cam0=[994.978 0 311.193; 0 994.978 254.877; 0 0 1]\n"
                                    "cam1=[994.978 0 342.279; 0 994.978 254.877; 0 0 1]\ndoffs=31.086\n"
                                    "baseline=193.001\nwidth=741\nheight=500\nndisp=70\n"));
  EXPECT_TRUE(rig.isRectified());
  EXPECT_NEAR(rig.baselineM(), 0.193001, 1e-12);
  EXPECT_NEAR(rectificationOf(rig).calibration.doffs_px, 31.086, 1e-9);
  EXPECT_EQ(rectificationOf(rig).calibration.num_disparities, 70);
  expectContains(
      messageOf([&] { readRig(put("m.txt", "cam0=[900 0 3; 0 900 2; 0 0 1]\ndoffs=0\nbaseline=0.193\n")); }),
      "counts metres");
  expectContains(messageOf([&] {
                   readRig(put("d.txt",
                               "cam0=[9 0 3; 0 9 2; 0 0 1]\ncam1=[9 0 5; 0 9 2; 0 0 1]\ndoffs=-2\n"
                               "baseline=100\n"));
                 }),
                 "doffs is '-2'; allowed: cx of cam1 minus cx of cam0");
  const auto rightCy = [](const char* cy) {
    return std::string("cam0=[9 0 3; 0 9 2; 0 0 1]\ncam1=[9 0 5; 0 9 ") + cy + "; 0 0 1]\nbaseline=100\n";
  };
  expectContains(messageOf([&] { readRig(put("y.txt", rightCy("1e308"))); }),
                 "line 2: cam1 is '[9 0 5; 0 9 1e308; 0 0 1]'; allowed: cy of cam0");
  EXPECT_NO_THROW(readRig(put("y.txt", "\xef\xbb\xbf" + rightCy("2")))) << "a byte order mark";
  const StereoRig metres = readRig(folder_ / "m.txt", {.unit_m = 1});
  EXPECT_NEAR(metres.baselineM(), 0.193, 1e-12);
}

const std::string kKittiRectified =
    "P0: 721.5377 0 609.5593 0 0 721.5377 172.854 0 0 0 1 0\n"
    "P1: 721.5377 0 609.5593 -387.5744 0 721.5377 172.854 0 0 0 1 0\n"
    "P2: 721.5377 0 609.5593 44.85728 0 721.5377 172.854 0.2163791 0 0 1 0.002745884\n"
    "P3: 721.5377 0 609.5593 -339.5242 0 721.5377 172.854 2.199936 0 0 1 0.002729905\n";

TEST_F(RigFile, KittiColourOrGray) {
  const StereoRig colour = readRig(put("000000.txt", kKittiRectified));
  EXPECT_TRUE(colour.isRectified());
  EXPECT_NEAR(colour.baselineM(), (44.85728 + 339.5242) / 721.5377, 1e-9);
  const StereoRig gray = readRig(folder_ / "000000.txt", {.left_camera = 0, .right_camera = 1});
  EXPECT_NEAR(gray.baselineM(), 387.5744 / 721.5377, 1e-9);
  expectContains(messageOf([&] { readRig(folder_ / "000000.txt", {.left_camera = 1, .right_camera = 0}); }),
                 "exchanged");
}

TEST_F(RigFile, KittiRaw) {
  const auto camera = [](const char* number, const char* t, const char* p) {
    const std::string n = number;
    return "S_" + n + ": 1392 512\nK_" + n + ": 960 0 694 0 957 241 0 0 1\nD_" + n +
           ": -0.36 0.2 0.001 0.0005 -0.07\nR_" + n + ": 1 0 0 0 1 0 0 0 1\nT_" + n + ": " + t + "\nS_rect_" +
           n + ": 1242 375\nR_rect_" + n + ": 1 0 0 0 1 0 0 0 1\nP_rect_" + n + ": 721.5 0 609.5 " + p +
           " 0 721.5 172.8 0 0 0 1 0\n";
  };
  const StereoRig rig =
      readRig(put("calib_cam_to_cam.txt", "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 0.1\n" +
                                              camera("02", "0.06 0 0", "43.29") +
                                              camera("03", "-0.473 0 0", "-341.2695")));
  EXPECT_EQ(rig.left.width, 1392);
  EXPECT_EQ(rig.left.distortion[4], -0.07);
  EXPECT_NEAR(rig.right_from_left_m[0], -0.533, 1e-12);
  EXPECT_EQ(rig.rectification->calibration.width, 1242);
  EXPECT_NEAR(rig.rectification->calibration.baseline_m, 0.533, 1e-9);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(RigFile, RefusesNonsenseNamingFileAndField) {
  writeRig(folder_ / "good.yml", rectificationOf(someRig()).calibration.width ? someRig() : StereoRig());
  const std::string own = bytesOf(folder_ / "good.yml");
  const struct {
    std::string leaf, text, part;
  } cases[] = {
      {"a.yml", "", "expected 'key: value'"},
      {"a.yml", "%YAML:1.0\n- 1\n- 2\n", "expected 'key: value'"},
      {"a.yml", "a: [1, 2", "no YAML"},
      {"a.yml", std::string(100000, '['), "no YAML"},
      {"a.yml", "a: 1\na: 2\n", "line 2: a second value for 'a'"},
      {"a.yml", "foo: 1\n", "no rig"},
      {"a.yml", std::string("M1: \0", 5), "byte 4: a control character"},
      {"a.yml", own + "\x04nonsense", "a control character; allowed: text"},
      {"a.yml", "M1: 5\n", "M1 is '5'; allowed: a list of numbers"},
      {"a.yml", "M1: [1, 0, 2]\n", "M1 is 3 values (1, 0, 2); allowed: 3 x 3 numbers"},
      {"a.yml", "M1: [500, 0, 2, 0, .nan, 3, 0, 0, 1]\n", "M1 holds '.nan'; allowed: finite numbers"},
      {"a.yml", "M1: [500, 0, 2, 0, nan, 3, 0, 0, 1]\n", "M1 holds 'nan'; allowed: finite numbers"},
      {"a.yml", "M1: [-500, 0, 2, 0, 500, 3, 0, 0, 1]\n",
       "M1 is 9 values (-500, 0, 2, 0, 500, 3, 0, 0, 1); allowed: [fx 0 cx"},
      {"a.yml", "M1: {rows: 3, cols: 3, data: [1, 2]}\n", "M1.data holds 2 numbers; allowed: 3 x 3"},
      {"a.yml", "M1: {rows: 3, cols: -3, data: [1, 2]}\n", "M1.cols is '-3'"},
      {"a.yml", "M1: {rows: 3, cols: 3}\n", "'M1.data' is missing"},
      {"a.yml", "M1: {rows: 3, cols: 3, dt: qq}\n", "M1.dt is 'qq'; allowed: one of u c w s i f d"},
      {"a.yml", "M1: {rows: 3, rows: 3}\n", "a second value for 'M1.rows'"},
      {"a.yml", replaced(own, "T:", "X:"), "'T' is missing"},
      {"a.yml", replaced(own, "length_unit: m", "length_unit: furlong"), "length_unit is 'furlong'"},
      {"a.yml", replaced(own, "length_unit: m", "length_unit: mm"), "baseline is 0.000119906 m"},
      {"a.yml", replaced(own, "image_width: 1280", "image_width: 1e9"), "image_width is '1e9'"},
      {"a.yml", replaced(own, "image_width: 1280", "image_width: 99999"), "image_width is '99999'"},
      {"a.yml", replaced(own, "image_width: 1280", "image_width: 200"), "left cx is 640.5"},
      {"a.yml", replaced(own, "image_width: 1280\n", ""), "'image_width' is missing"},
      {"a.yml", replaced(own, "image_height: 720\n", ""), "'image_height' is missing"},
      {"a.yml", replaced(own, "polynomial", "magic"), "distortion_model is 'magic'"},
      {"a.yml", replaced(own, "polynomial", "fisheye"), "D1 is 5 values (-1.7"},
      {"a.yml", replaced(own, "data: [ ", "data: [ -"), "M1 is 9 values (-"},
      {"a.yml", own + "R1: 5\n", "'P1' is missing"},
      {"k.yaml", replaced(kKalibr, "pinhole", "omni"), "cam0.camera_model is 'omni'"},
      {"k.yaml", replaced(kKalibr, "radtan", "fov"), "cam0.distortion_model is 'fov'"},
      {"k.yaml", replaced(kKalibr, "458.6,", "-458.6,"),
       "cam0.intrinsics is 4 values (-458.6, 457.3, 367.2, 248.4); allowed: [fu"},
      {"k.yaml", replaced(kKalibr, "752, 480", "752.5, 480"), "cam0.resolution is 2 values (752.5, 480)"},
      {"k.yaml", replaced(kKalibr, "-0.28", "-0,28"),
       "cam0.distortion_coeffs is 5 values (-0, 28, 0.07, 0.0002, 0.00002); allowed: 4"},
      {"k.yaml", replaced(kKalibr, "  - [0.0, 0.0, 0.0, 1.0]\n", ""), "cam1.T_cn_cnm1 is 3 values"},
      {"k.yaml", replaced(kKalibr, "T_cn_cnm1", "T_cam_imu"), "'cam1.T_cn_cnm1' is missing"},
      {"k.yaml", replaced(kKalibr, "-0.11]", "-110]"),
       "baseline is 110 m; allowed: 0.001 to 10 m (perhaps the file counts millimetres: pomona rig convert "
       "--unit mm)"},
      {"k.yaml", replaced(kKalibr, "[1.0, 0.0, 0.0, -0.11]", "[1.5, 0.0, 0.0, -0.11]"), "R is"},
      {"k.yaml", replaced(kKalibr, "-0.11]", "-0.0]"), "baseline is 0.000894427 m"},
      {"k.yaml", kKalibr.substr(0, kKalibr.find("cam1")), "'cam1' is missing"},
      {"k.yaml", kKalibr.substr(0, kKalibr.size() / 2), "k.yaml: line"},
      {"kitti.txt", replaced(kKittiRectified, "P3", "P9"), "ends without 'P3:'"},
      {"kitti.txt", replaced(kKittiRectified, "44.85728", "nan"), "P2 is"},
      {"kitti.txt", replaced(kKittiRectified, "44.85728 0 721.5377", "44.85728 0 720"),
       "allowed: equal fx and fy, as in a rectified view (here 721.5377 and 720)"},
      {"kitti.txt", replaced(kKittiRectified, "-339.5242 0 721.5377 172.854", "-339.5242 0 721.5377 180"),
       "have cy 172.854 (left) and 180 (right); allowed: the same"},
      {"kitti.txt", replaced(kKittiRectified, " 0.002729905", ""), "12 finite numbers"},
      {"kitti.txt", replaced(kKittiRectified, "-339.5242", "-339524.2"), "baseline is"},
      {"what.txt", "hello\n", "no known calibration"},
      {"what.bin", "", "no known calibration"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.leaf + " " + c.part);
    const std::string message = messageOf([&] { readRig(put(c.leaf, c.text)); });
    expectContains(message, c.part);
    expectContains(message, c.leaf);
    EXPECT_EQ(message.find('\n'), message.npos) << message;
  }
  expectContains(messageOf([&] { readRig(folder_ / "absent.yml"); }), "absent.yml: cannot be read");
  expectContains(messageOf([&] { readRig(folder_ / "."); }), "no left.yaml");
  expectContains(messageOf([&] { readRig(put("big.yml", std::string(2 << 20, ' '))); }), "too large");
}

TEST_F(RigFile, RosRefusesNonsenseNamingFileAndField) {
  writeRig(folder_ / "ros", rigOf({490, 318, 238, 0.12, 0, 640, 480, 0}), RigFormat::kRos);
  const std::string good = bytesOf(folder_ / "ros/right.yaml");
  const struct {
    std::string text, part;
  } cases[] = {
      {"", "expected 'key: value'"},
      {replaced(good, "image_width", "breadth"), "'image_width' is missing"},
      {replaced(good, "projection_matrix", "P_matrix"), "'projection_matrix' is missing"},
      {replaced(good, "rectification_matrix", "r_matrix"), "'rectification_matrix' is missing"},
      {replaced(good, "[490, 0, 318, 0, 490,", "[-490, 0, 318, 0, -490,"), "camera_matrix is"},
      {replaced(good, "[490, 0, 318, 0, 490,", "[.nan, 0, 318, 0, 490,"), "camera_matrix.data holds '.nan'"},
      {replaced(good, "[490, 0, 318, 0, 490,", "[490, 0, 318, 0,"), "camera_matrix.data holds 8 numbers"},
      {replaced(good, "[490, 0, 318, -58.8,", "[490, 0, 318, 1e999,"),
       "projection_matrix.data holds '1e999'"},
      {replaced(good, "[490, 0, 318, -58.8,", "[480, 0, 318, -58.8,"), "projection_matrix is"},
      {replaced(good, "[490, 0, 318, -58.8,", "[490, 0, 318, -58800,"), "baseline is 120 m"},
      {replaced(good, "plumb_bob", "fov"), "distortion_model is 'fov'"},
      {replaced(good, "image_height: 480", "image_height: -480"), "image_height is '-480'"},
      {replaced(good, "image_height: 480", "image_height: 480\nheight: 240"),
       "a second value for 'image_height', as 'height'"},
      {replaced(good, "image_height: 480", "image_height: 240"), "right size is 640x240"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.part);
    put("right.yaml", c.text);
    const std::string message =
        messageOf([&] { readRigPair(folder_ / "ros/left.yaml", folder_ / "right.yaml"); });
    expectContains(message, c.part);
    expectContains(message, "right.yaml");
    EXPECT_EQ(message.find('\n'), message.npos) << message;
  }
}

// Whatever is cut off or altered: an error or a valid rig, never anything else.
TEST_F(RigFile, DamageIsNoticedOrHarmless) {
  StereoRig rig = someRig();
  rig.rectification = rectificationOf(rig);
  writeRig(folder_ / "good.yml", rig);
  const std::string own = bytesOf(folder_ / "good.yml");
  writeRig(folder_ / "calib.txt", rig, RigFormat::kMiddlebury);
  const std::string middlebury = bytesOf(folder_ / "calib.txt");
  for (const std::string& good : {own, kKalibr, kKittiRectified, middlebury}) {
    const std::string leaf = good == own || good == kKalibr ? "x.yaml" : "x.txt";
    for (std::size_t i = 0; i < good.size(); i += 23)
      for (const char* damage : {"cut", "-", "9", "\n", "["}) {
        std::string text = good;
        if (damage[0] == 'c')
          text.resize(i);
        else
          text[i] = damage[0];
        try {
          readRig(put(leaf, text)).validate();
        } catch (const std::runtime_error& e) {
          EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
        }
      }
  }
}

TEST_F(RigFile, MiddleburyOutIsTheRectifiedForm) {
  writeRig(folder_ / "calib.txt", someRig(), RigFormat::kMiddlebury);
  expectSameRectification({.calibration = rectificationOf(readRig(folder_ / "calib.txt")).calibration},
                          {.calibration = rectificationOf(someRig()).calibration}, 1e-9);
}

}  // namespace
}  // namespace pomona
