// Rectification against the lens model and OpenCV, and the engine that rectifies for itself.
#include "camera/rectify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "datasets/named_scenes.h"
#include "datasets/render.h"
#include "file_support.h"
#include "pomona/engine.h"

namespace pomona {
namespace {

StereoRig unrectifiedRig(int width, int height) {
  StereoRig rig;
  const double f = 0.83 * width;
  rig.left = {width,
              height,
              f,
              f * 0.999,
              0.505 * width,
              0.49 * height,
              DistortionModel::kPolynomial,
              {-0.17, 0.03, 0.0005, -0.0004, 0.001}};
  rig.right = {width,
               height,
               f * 0.998,
               f * 0.997,
               0.495 * width,
               0.51 * height,
               DistortionModel::kPolynomial,
               {-0.16, 0.02, -0.0003, 0.0005, 0.002}};
  cv::Rodrigues(cv::Vec3d(0.008, 0.012, -0.009), rig.right_from_left_rotation);
  rig.right_from_left_m = {-0.1199, 0.0006, 0.0013};
  return rig;
}

cv::Mat noise(int width, int height, int type, std::uint64_t seed) {
  cv::Mat image(height, width, type);
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, CV_MAT_DEPTH(type) == CV_16U ? 65536 : 256);
  return image;
}

template <typename T>
double at(const cv::Mat& image, int y, int x, int channel) {
  return image.ptr<T>(y)[x * image.channels() + channel];
}

// The textbook way, in floating point: for each pixel of the rectified view, ask the lens, and interpolate.
template <typename T>
void expectTextbook(const cv::Mat& view, const cv::Mat& rectified, const CameraModel& camera,
                    const cv::Matx33d& rotation, double cx, const StereoCalibration& c) {
  for (int y = 0; y < rectified.rows; y += 3)
    for (int x = 0; x < rectified.cols; x += 3) {
      const cv::Vec3d d = rotation.t() * cv::Vec3d((x - cx) / c.focal_px, (y - c.cy_px) / c.focal_px, 1);
      std::vector<cv::Point2d> pixel;
      cv::projectPoints(std::vector<cv::Point3d>{{d[0], d[1], d[2]}}, cv::Vec3d(), cv::Vec3d(),
                        camera.matrix(), cv::Mat(camera.distortion), pixel);
      const double u = pixel[0].x, v = pixel[0].y;
      const int ix = static_cast<int>(std::floor(u)), iy = static_cast<int>(std::floor(v));
      if (ix < 1 || iy < 1 || ix + 2 >= view.cols || iy + 2 >= view.rows) continue;
      for (int k = 0; k < view.channels(); ++k) {
        const double p00 = at<T>(view, iy, ix, k), p01 = at<T>(view, iy, ix + 1, k);
        const double p10 = at<T>(view, iy + 1, ix, k), p11 = at<T>(view, iy + 1, ix + 1, k);
        const double expected = (p00 * (1 - u + ix) + p01 * (u - ix)) * (1 - v + iy) +
                                (p10 * (1 - u + ix) + p11 * (u - ix)) * (v - iy);
        // Positions are rounded to 1/256 px, and the image changes by its whole range per pixel.
        const double tolerance = (sizeof(T) == 1 ? 255 : 65535) / 256.0 + 1;
        ASSERT_NEAR(at<T>(rectified, y, x, k), expected, tolerance) << x << " " << y << " " << k;
      }
    }
}

TEST(Rectify, IsTheLensModelForEveryTypeAndThread) {
  const StereoRig rig = unrectifiedRig(161, 101);
  const Rectification r = rectificationOf(rig);
  const StereoCalibration& c = r.calibration;
  Rectifier rectifier(rig), other(rig);
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC1, CV_16UC3}) {
    const cv::Mat left = noise(161, 101, type, 1);
    const cv::Mat wide = noise(200, 120, type, 2);
    const cv::Mat right = wide(cv::Rect(7, 5, 161, 101));  // rows with a stride
    rectifier.rectify(left, right, 1);
    if (left.depth() == CV_8U) {
      expectTextbook<std::uint8_t>(left, rectifier.left(), rig.left, r.left_rotation, c.cx_px, c);
      expectTextbook<std::uint8_t>(right, rectifier.right(), rig.right, r.right_rotation,
                                   c.cx_px + c.doffs_px, c);
    } else {
      expectTextbook<std::uint16_t>(left, rectifier.left(), rig.left, r.left_rotation, c.cx_px, c);
      expectTextbook<std::uint16_t>(right, rectifier.right(), rig.right, r.right_rotation,
                                    c.cx_px + c.doffs_px, c);
    }
    for (const int threads : {2, 3, 7}) {
      other.rectify(left, right, threads);
      EXPECT_EQ(cv::norm(rectifier.left(), other.left(), cv::NORM_INF), 0) << type << " " << threads;
      EXPECT_EQ(cv::norm(rectifier.right(), other.right(), cv::NORM_INF), 0) << type << " " << threads;
    }
    cv::Mat full(101, 161, type, cv::Scalar::all(left.depth() == CV_8U ? 255 : 65535));
    rectifier.rectify(full, full, 2);  // largest sums: nothing overflows, nothing is lost
    EXPECT_EQ(cv::norm(rectifier.left(), full, cv::NORM_INF), 0);
  }
}

TEST(Rectify, ColorsAreRectifiedLikeGrayOfEachChannel) {
  for (const cv::Size size : {cv::Size(161, 101), cv::Size(64, 48), cv::Size(17, 12)}) {
    StereoRig rig = unrectifiedRig(size.width, size.height);
    if (size.width == 64) {  // shows all of the views, up to their last pixel
      rig.rectification = rectificationOf(rig);
      rig.rectification->calibration.focal_px *= 0.6;
    }
    Rectifier rectifier(rig), channel(rig);
    const cv::Mat left = noise(size.width, size.height, CV_8UC3, 5), right = ~left;
    rectifier.rectify(left, right, 2);
    for (int k = 0; k < 3; ++k) {
      cv::Mat left_channel, right_channel, found;
      cv::extractChannel(left, left_channel, k);
      cv::extractChannel(right, right_channel, k);
      channel.rectify(left_channel, right_channel, 1);
      cv::extractChannel(rectifier.left(), found, k);
      EXPECT_EQ(cv::norm(found, channel.left(), cv::NORM_INF), 0) << size << " channel " << k;
      cv::extractChannel(rectifier.right(), found, k);
      EXPECT_EQ(cv::norm(found, channel.right(), cv::NORM_INF), 0) << size << " channel " << k;
    }
  }
}

TEST(Rectify, StatedRectificationMayShowTheOutside) {
  StereoRig rig = unrectifiedRig(160, 100);
  rig.rectification = rectificationOf(rig);
  rig.rectification->calibration.focal_px *= 0.7;
  rig.rectification->calibration.width = 180;
  rig.rectification->calibration.cx_px += 10;
  Rectifier rectifier(rig);
  const cv::Mat view(100, 160, CV_8UC1, cv::Scalar(200));
  rectifier.rectify(view, view, 2);
  ASSERT_EQ(rectifier.left().size(), cv::Size(180, 100));
  EXPECT_EQ(rectifier.left().at<std::uint8_t>(0, 0), 0);
  EXPECT_EQ(rectifier.left().at<std::uint8_t>(50, 90), 200);
  const cv::Mat seen = rectifier.rectifyMask({}, 2);
  for (int y = 0; y < seen.rows; ++y)
    for (int x = 0; x < seen.cols; ++x)
      ASSERT_EQ(seen.at<std::uint8_t>(y, x) != 0, rectifier.left().at<std::uint8_t>(y, x) != 0);

  cv::Mat mask(100, 160, CV_8UC1, cv::Scalar(255));
  mask.colRange(0, 80).setTo(0);
  const cv::Mat half = rectifier.rectifyMask(mask, 2);
  EXPECT_EQ(half.at<std::uint8_t>(50, 60), 0);
  EXPECT_EQ(half.at<std::uint8_t>(50, 120), 255);
  EXPECT_TRUE(Rectifier(unrectifiedRig(160, 100)).rectifyMask({}, 2).empty());  // alpha 0: all is seen
}

TEST(Rectify, FisheyeAlignsRows) {
  StereoRig rig = unrectifiedRig(640, 400);
  rig.left.distortion_model = rig.right.distortion_model = DistortionModel::kFisheye;
  rig.left.distortion = {-0.01, 0.004, -0.002, 0.0005};
  rig.right.distortion = {-0.012, 0.003, -0.001, 0.0004};
  const Rectification r = rectificationOf(rig);
  EXPECT_NEAR(r.calibration.baseline_m, rig.baselineM(), 1e-9);
  EXPECT_NO_THROW(Rectifier{rig});
}

TEST(Rectify, RefusesNamingTheReason) {
  const StereoRig rig = unrectifiedRig(160, 100);
  Rectifier rectifier(rig);
  const cv::Mat good(100, 160, CV_8UC1), small(50, 80, CV_8UC1), real(100, 160, CV_32FC1),
      color(100, 160, CV_8UC3);
  const auto refusal = [&](const cv::Mat& l, const cv::Mat& r) {
    return messageOf<std::invalid_argument>([&] { rectifier.rectify(l, r, 1); });
  };
  expectContains(refusal(small, good), "left is 80x50; allowed: the rig's 160x100");
  expectContains(refusal(good, small), "right is 80x50");
  expectContains(refusal(real, good), "left is of type CV_32FC1");
  expectContains(refusal(good, color), "same type");
  expectContains(messageOf<std::invalid_argument>([&] { rectifier.rectifyMask(small, 1); }),
                 "mask is CV_8UC1 of 80x50");
  StereoRig vertical = rig;
  vertical.right_from_left_m = {0, -0.12, 0};
  expectContains(messageOf<std::invalid_argument>([&] { StereoEngine(Options(), vertical); }),
                 "one above the other");
  StereoRig exchanged = rig;
  exchanged.right_from_left_m *= -1;
  expectContains(messageOf<std::invalid_argument>([&] { StereoEngine(Options(), exchanged); }), "exchanged");
  StereoRig sizeless = rigOf({1000, 300, 200, 0.1});
  EXPECT_NO_THROW(StereoEngine(Options(), sizeless));  // needs none
}

// Views as an unrectified camera would take them of a rectified scene: every raw pixel asks where it is
// there.
std::pair<cv::Mat, cv::Mat> throughLenses(const RenderedPair& pair, const StereoRig& rig,
                                          const Rectification& r) {
  cv::Mat views[2];
  for (int side = 0; side < 2; ++side) {
    const CameraModel& camera = side == 0 ? rig.left : rig.right;
    const cv::Matx33d& rotation = side == 0 ? r.left_rotation : r.right_rotation;
    const StereoCalibration& c = r.calibration;
    cv::Mat map(camera.height, camera.width, CV_32FC2);
    for (int y = 0; y < map.rows; ++y)
      for (int x = 0; x < map.cols; ++x) {
        const cv::Vec2d d = camera.directionOf({1.0 * x, 1.0 * y});
        const cv::Vec3d p = rotation * cv::Vec3d(d[0], d[1], 1);
        map.at<cv::Vec2f>(y, x) = {
            static_cast<float>(c.focal_px * p[0] / p[2] + c.cx_px + (side == 1 ? c.doffs_px : 0)),
            static_cast<float>(c.focal_px * p[1] / p[2] + c.cy_px)};
      }
    cv::remap(side == 0 ? pair.left.image : pair.right.image, views[side], map, cv::noArray(),
              cv::INTER_CUBIC);
  }
  return {views[0], views[1]};
}

double wrongShare(const cv::Mat& disparity, const cv::Mat& truth) {
  int wrong = 0;
  for (int y = 0; y < truth.rows; ++y)
    for (int x = 0; x < truth.cols; ++x)
      wrong += !(std::abs(disparity.at<float>(y, x) - truth.at<float>(y, x)) <= 1);
  return wrong / static_cast<double>(truth.total());
}

TEST(EngineWithRig, MatchesAsIfTheViewsWereRectified) {
  const RenderedPair pair = render(namedScene("boxes", 4, 480, 320, 48));
  const StereoRig rig = [&] {
    StereoRig raw = unrectifiedRig(480, 320);
    raw.rectification = rectificationOf(raw);
    return raw;
  }();
  const auto [left, right] = throughLenses(pair, rig, *rig.rectification);
  Options options;
  options.num_disparities = 48;
  StereoEngine engine(options, rig), plain(options);
  const double rectified = wrongShare(engine.compute(left, right).disparity, pair.left.disparity);
  const double ideal =
      wrongShare(plain.compute(pair.left.image, pair.right.image).disparity, pair.left.disparity);
  const double raw = wrongShare(plain.compute(left, right).disparity, pair.left.disparity);
  EXPECT_LT(rectified, ideal + 0.02);
  EXPECT_GT(raw, 0.3);  // without rectification these views cannot be matched
  EXPECT_EQ(engine.calibration().focal_px, rig.rectification->calibration.focal_px);
  EXPECT_EQ(engine.leftView().size(), cv::Size(480, 320));
  EXPECT_LT(cv::norm(engine.leftView(), pair.left.image, cv::NORM_L1) / (3.0 * 480 * 320), 6);

  options.threads = 3;
  options.isa = "scalar";
  StereoEngine other(options, rig);
  const StereoResult& a = engine.compute(left, right);
  const StereoResult& b = other.compute(left, right);
  EXPECT_EQ(std::memcmp(a.disparity.data, b.disparity.data, 480 * sizeof(float)), 0);
  EXPECT_EQ(a.row_offset_px, b.row_offset_px);
  EXPECT_EQ(a.row_error_px, b.row_error_px);
}

TEST(EngineWithRig, RectifiedRigLeavesViewsAlone) {
  const RenderedPair pair = render(namedScene("planes", 4, 160, 100, 30));
  Options options;
  options.num_disparities = 32;
  StereoEngine engine(options, rigOf(pair.calibration)), plain(options);
  const StereoResult& a = engine.compute(pair.left.image, pair.right.image);
  const StereoResult& b = plain.compute(pair.left.image, pair.right.image);
  EXPECT_EQ(engine.leftView().data, pair.left.image.data);
  EXPECT_EQ(cv::norm(a.confidence, b.confidence, cv::NORM_INF), 0);
  EXPECT_THROW(plain.calibration(), std::logic_error);
  EXPECT_EQ(engine.calibration().baseline_m, pair.calibration.baseline_m);

  // Views of another size have another focal length: their distances would be wrong.
  const cv::Mat quarter = pair.left.image(cv::Rect(0, 0, 80, 50));
  expectContains(messageOf<std::invalid_argument>([&] { engine.compute(quarter, quarter); }),
                 "left is 80x50; allowed: the rig's 160x100");
  StereoCalibration sizeless = pair.calibration;
  sizeless.width = sizeless.height = 0;
  EXPECT_NO_THROW(StereoEngine(options, rigOf(sizeless)).compute(quarter, quarter));
}

}  // namespace
}  // namespace pomona
