// Calibration against boards drawn through lenses that are known, and against real pictures.
#include "camera/calibrate.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/calib3d.hpp>

#include "datasets/chessboard.h"
#include "datasets/image_file.h"
#include "file_support.h"

namespace pomona {
namespace {

// 1280 x 720, a lens as in a harvesting robot's stereo camera.
StereoRig knownRig() {
  StereoRig rig;
  rig.left = {1280,
              720,
              1056.6,
              1055.9,
              645.2,
              357.4,
              DistortionModel::kPolynomial,
              {-0.172, 0.031, 0.0006, -0.0004, -0.004}};
  rig.right = {1280,
               720,
               1054.1,
               1053.8,
               633.9,
               362.7,
               DistortionModel::kPolynomial,
               {-0.168, 0.026, -0.0003, 0.0005, 0.003}};
  cv::Rodrigues(cv::Vec3d(0.003, 0.011, -0.004), rig.right_from_left_rotation);
  rig.right_from_left_m = {-0.1199, 0.0006, 0.0013};
  return rig;
}

TEST(Lens, AgreesWithOpenCvAndInverts) {
  CameraModel lenses[] = {knownRig().left, knownRig().left, knownRig().left};
  lenses[1].distortion = {-0.2, 0.05, 0.001, -0.002, 0.01, 0.03, -0.01, 0.002};
  lenses[2].distortion_model = DistortionModel::kFisheye;
  lenses[2].distortion = {-0.01, 0.004, -0.002, 0.0005};
  for (const CameraModel& lens : lenses)
    for (const cv::Vec2d& direction : {cv::Vec2d(0, 0), cv::Vec2d(0.3, -0.2), cv::Vec2d(-0.5, 0.3)}) {
      std::vector<cv::Point3d> points{{direction[0], direction[1], 1}};
      std::vector<cv::Point2d> expected;
      const cv::Vec3d zero;
      if (lens.distortion_model == DistortionModel::kFisheye)
        cv::fisheye::projectPoints(points, expected, zero, zero, lens.matrix(),
                                   cv::Vec4d(lens.distortion.data()));
      else
        cv::projectPoints(points, zero, zero, lens.matrix(),
                          cv::Mat(1, 8, CV_64F, (void*)lens.distortion.data()), expected);
      const cv::Vec2d pixel = lens.pixelOf(direction);
      EXPECT_NEAR(pixel[0], expected[0].x, 1e-9);
      EXPECT_NEAR(pixel[1], expected[0].y, 1e-9);
      EXPECT_LE(cv::norm(lens.directionOf(pixel), direction), 1e-9);
    }
  CameraModel folded = knownRig().left;
  folded.distortion = {-0.8};
  EXPECT_TRUE(std::isnan(folded.directionOf({1270, 10})[0]));  // no direction is seen so far out
}

std::vector<BoardView> knownViews(const StereoRig& rig, const Chessboard& board, int count, double noise) {
  std::vector<BoardView> views;
  const ChessboardRenderer left(rig.left, board), right(rig.right, board);
  for (const BoardPose& pose : scatteredPoses(rig, board, count, 7)) {
    const auto seed = 2 * views.size();
    const std::string name = "view" + std::to_string(views.size());
    views.push_back(findBoard(name, left.render(pose, noise, seed),
                              right.render(seenFromRight(rig, pose), noise, seed + 1),
                              {board.columns, board.rows, board.square_m}));
    EXPECT_EQ(views.back().rejected, "") << name;
  }
  return views;
}

TEST(Chessboard, CornersAreWhereTheLensPutsThem) {
  const StereoRig rig = knownRig();
  const Chessboard board{9, 6, 0.025};
  const BoardPose pose = scatteredPoses(rig, board, 1, 3)[0];
  const BoardView view =
      findBoard("v", ChessboardRenderer(rig.left, board).render(pose),
                ChessboardRenderer(rig.right, board).render(seenFromRight(rig, pose)), {9, 6, 0.025});
  ASSERT_EQ(view.left.size(), 54u) << view.rejected;
  double worst_px = 0;
  for (const auto& [camera, seen, corners] :
       {std::tuple(&rig.left, pose, &view.left),
        std::tuple(&rig.right, seenFromRight(rig, pose), &view.right)}) {
    // Which corner the search begins with is open.
    const auto distance = [&, &camera = camera, &seen = seen, &corners = corners](std::size_t found, int i,
                                                                                  int j) {
      const cv::Vec3d p = seen.rotation * cv::Vec3d(i * 0.025, j * 0.025, 0) + seen.translation_m;
      return cv::norm(cv::Vec2d((*corners)[found].x, (*corners)[found].y),
                      camera->pixelOf({p[0] / p[2], p[1] / p[2]}));
    };
    const bool reversed = distance(0, 0, 0) > 5;
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 9; ++i)
        worst_px = std::max(worst_px, distance(static_cast<std::size_t>(9 * j + i), reversed ? 8 - i : i,
                                               reversed ? 5 - j : j));
  }
  EXPECT_LT(worst_px, 0.15);
}

void expectWithin3Sigma(double found, double truth, double sigma, const std::string& what) {
  EXPECT_GT(sigma, 0) << what;
  EXPECT_LE(std::abs(found - truth), 3 * sigma)
      << what << ": " << found << " for " << truth << " +- " << sigma;
}

TEST(Calibrate, RecoversAKnownRigWithinItsOwnDeviations) {
  const StereoRig truth = knownRig();
  const Chessboard board{9, 6, 0.025};
  const CalibrationReport report =
      calibrateStereo(knownViews(truth, board, 24, 3), {1280, 720}, {9, 6, 0.025});
  EXPECT_EQ(report.used_views, 24);
  EXPECT_LT(report.rms_px, 0.1);
  for (const auto& [name, found, known, sigma] :
       {std::tuple("left ", &report.rig.left, &truth.left, &report.left_deviation),
        std::tuple("right ", &report.rig.right, &truth.right, &report.right_deviation)}) {
    const std::string camera = name;
    expectWithin3Sigma(found->fx_px, known->fx_px, sigma->fx_px, camera + "fx");
    expectWithin3Sigma(found->fy_px, known->fy_px, sigma->fy_px, camera + "fy");
    expectWithin3Sigma(found->cx_px, known->cx_px, sigma->cx_px, camera + "cx");
    expectWithin3Sigma(found->cy_px, known->cy_px, sigma->cy_px, camera + "cy");
    for (std::size_t i = 0; i < 5; ++i)
      expectWithin3Sigma(found->distortion[i], known->distortion[i], sigma->distortion[i],
                         camera + "distortion " + std::to_string(i));
    EXPECT_LT(sigma->fx_px, 1);  // tight enough to mean something
  }
  cv::Vec3d difference;
  cv::Rodrigues(report.rig.right_from_left_rotation * truth.right_from_left_rotation.t(), difference);
  for (int i = 0; i < 3; ++i) {
    expectWithin3Sigma(difference[i], 0, report.rotation_deviation[i], "rotation");
    expectWithin3Sigma(report.rig.right_from_left_m[i], truth.right_from_left_m[i],
                       report.translation_deviation_m[i], "T");
  }
  expectWithin3Sigma(report.rig.baselineM(), truth.baselineM(), report.baseline_deviation_m, "baseline");
  EXPECT_LT(report.baseline_deviation_m, 0.0005);
  EXPECT_LT(report.epipolar_mean_px, 0.1);
  EXPECT_LE(report.epipolar_mean_px, report.epipolar_p95_px);
  for (const CalibrationReport::View& view : report.views) EXPECT_GT(view.rms_px, 0);
}

// Corners by the model itself with a known scatter: exercises everything behind the search, quickly.
std::vector<BoardView> idealViews(const StereoRig& rig, int count, double scatter_px, std::uint64_t seed) {
  const Chessboard board{9, 6, 0.025};
  cv::RNG random(seed);
  std::vector<BoardView> views;
  for (const BoardPose& pose : scatteredPoses(rig, board, count, seed)) {
    BoardView view{"view" + std::to_string(views.size()), {}, {}, ""};
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 9; ++i)
        for (bool right : {false, true}) {
          const BoardPose seen = right ? seenFromRight(rig, pose) : pose;
          const cv::Vec3d p = seen.rotation * cv::Vec3d(i * 0.025, j * 0.025, 0) + seen.translation_m;
          const cv::Vec2d pixel = (right ? rig.right : rig.left).pixelOf({p[0] / p[2], p[1] / p[2]});
          (right ? view.right : view.left)
              .emplace_back(static_cast<float>(pixel[0] + random.gaussian(scatter_px)),
                            static_cast<float>(pixel[1] + random.gaussian(scatter_px)));
        }
    views.push_back(view);
  }
  return views;
}

// The predicted deviations are those that repetitions show.
TEST(Calibrate, DeviationsPredictTheScatter) {
  const StereoRig truth = knownRig();
  constexpr int kRuns = 16;
  double fx2 = 0, k1_2 = 0, baseline2 = 0, t_2 = 0;
  int parameters = 0;
  for (int run = 0; run < kRuns; ++run) {
    const CalibrationReport r =
        calibrateStereo(idealViews(truth, 12, 0.1, 100 + run), {1280, 720}, {9, 6, 0.025});
    const auto square = [](double x) { return x * x; };
    fx2 += square((r.rig.left.fx_px - truth.left.fx_px) / r.left_deviation.fx_px);
    k1_2 += square((r.rig.right.distortion[0] - truth.right.distortion[0]) / r.right_deviation.distortion[0]);
    baseline2 += square((r.rig.baselineM() - truth.baselineM()) / r.baseline_deviation_m);
    t_2 += square((r.rig.right_from_left_m[2] - truth.right_from_left_m[2]) / r.translation_deviation_m[2]);
    ++parameters;
    EXPECT_NEAR(r.rms_px, 0.1 * std::sqrt(2.0), 0.015);
  }
  for (const double sum : {fx2, k1_2, baseline2, t_2}) {
    EXPECT_GT(sum / parameters, 0.4);  // chi square of 16: 0.43 to 2.0 holds 98 %
    EXPECT_LT(sum / parameters, 2.1);
  }
}

TEST(Calibrate, RejectsViewsThatDontFit) {
  std::vector<BoardView> views = idealViews(knownRig(), 14, 0.05, 5);
  for (std::size_t i = 0; i < views[3].right.size(); ++i) views[3].right[i].y += i % 2 ? 3.f : -3.f;
  views[6].rejected = "no board";
  const CalibrationReport report = calibrateStereo(views, {1280, 720}, {9, 6, 0.025});
  EXPECT_EQ(report.used_views, 12);
  expectContains(report.views[3].rejected, "rms ");
  EXPECT_EQ(report.views[6].rejected, "no board");
  EXPECT_LT(report.rms_px, 0.1);
  CalibrateOptions keep;
  keep.outlier_factor = 0;
  EXPECT_EQ(calibrateStereo(views, {1280, 720}, {9, 6, 0.025}, keep).used_views, 13);
}

bool warnsOf(const CalibrationReport& report, const std::string& part) {
  return std::any_of(report.warnings.begin(), report.warnings.end(),
                     [&](const std::string& w) { return w.find(part) != w.npos; });
}

TEST(Calibrate, WarnsOfWhatMakesItWeak) {
  std::vector<BoardView> views = idealViews(knownRig(), 20, 0.05, 6);
  const CalibrationReport good = calibrateStereo(views, {1280, 720}, {9, 6, 0.025});
  EXPECT_TRUE(good.warnings.empty()) << good.warnings[0];
  views.resize(6);
  views.push_back(views[2]);
  for (auto* corners : {&views.back().left, &views.back().right})
    for (cv::Point2f& corner : *corners) corner.x += 2;
  const CalibrationReport weak = calibrateStereo(views, {1280, 720}, {9, 6, 0.025});
  EXPECT_TRUE(warnsOf(weak, "only 7 views"));
  EXPECT_TRUE(warnsOf(weak, "1 view repeats another: board"));
  const CalibrationReport scattered =
      calibrateStereo(idealViews(knownRig(), 12, 1, 6), {1280, 720}, {9, 6, 0.025});
  EXPECT_TRUE(warnsOf(scattered, "rms "));
  EXPECT_TRUE(warnsOf(scattered, "epipolar error"));
}

TEST(Calibrate, RejectsViewsThatTellNothingNew) {
  std::vector<BoardView> views = idealViews(knownRig(), 6, 0.02, 8);
  views[5].right = views[5].left;
  views.push_back(views[1]);
  for (cv::Point2f& corner : views.back().left) corner += cv::Point2f(0.1f, -0.1f);
  const CalibrationReport report = calibrateStereo(views, {1280, 720}, {9, 6, 0.025});
  EXPECT_EQ(report.used_views, 5);
  expectContains(report.views[5].rejected, "left and right show the board in the same place");
  EXPECT_EQ(report.views[6].rejected, "the board is in the same place as in view1");
}

TEST(Calibrate, SaysWhyThereAreTooFewViews) {
  std::vector<BoardView> views = idealViews(knownRig(), 2, 0.05, 6);
  const auto add = [&](const std::string& name, const std::string& rejected) {
    views.push_back({name, {}, {}, rejected});
  };
  for (int i = 0; i < 5; ++i) add("a" + std::to_string(i), "blurred");
  add("b", "no board");
  views.push_back(views[1]);
  views.back().name = "c";
  EXPECT_EQ(messageOf<std::invalid_argument>([&] {
              calibrateStereo(views, {1280, 720}, {9, 6, 0.025});
            }),
            "2 of 9 views can be used; at least 3 are needed; rejected: a0, a1, a2 and 2 more (blurred), b "
            "(no board), c (the board is in the same place as in view1)");
}

TEST(Calibrate, SaysThatViewsAreTooAlike) {
  std::vector<BoardView> views = idealViews(knownRig(), 3, 0.05, 3);
  views.erase(views.begin());
  views.resize(1);  // its copies, moved a little, fit cameras that no one can build
  for (int i = 1; i < 5; ++i) {
    views.push_back(views.back());
    for (auto* corners : {&views.back().left, &views.back().right})
      for (cv::Point2f& corner : *corners) corner += cv::Point2f(2, i % 2 ? 2 : -2);
  }
  const std::string message = messageOf<std::invalid_argument>([&] {
    calibrateStereo(views, {1280, 720}, {9, 6, 0.025});
  });
  expectContains(message, "the views are too alike to calibrate by: the board moves by 8 px at most");

  views = idealViews(knownRig(), 8, 0.05, 3);
  for (BoardView& view : views) std::swap(view.left, view.right);
  expectContains(messageOf<std::invalid_argument>([&] {
                   calibrateStereo(views, {1280, 720}, {9, 6, 0.025});
                 }),
                 "left and right are exchanged");
}

TEST(Calibrate, CoverageCountsCells) {
  BoardView view{"v", {{10, 10}, {1270, 710}}, {{600, 300}, {601, 300}}, ""};
  BoardView rejected{"r", {{300, 300}}, {{10, 10}}, "blurred"};
  const auto coverage = coverageOf({view, rejected}, {1280, 720});
  EXPECT_DOUBLE_EQ(coverage[0], 2 / 80.0);
  EXPECT_DOUBLE_EQ(coverage[1], 1 / 80.0);
  const cv::Mat picture = coveragePicture({view, rejected}, {1280, 720});
  EXPECT_EQ(picture.size(), cv::Size(2568, 720));
  EXPECT_NE(picture.at<cv::Vec3b>(10, 10), picture.at<cv::Vec3b>(30, 60));  // a corner in a bright cell
  EXPECT_GT(picture.at<cv::Vec3b>(30, 60)[0], picture.at<cv::Vec3b>(300, 300)[0]);
}

TEST(Calibrate, RefusesWhatCannotBe) {
  const std::vector<BoardView> views = idealViews(knownRig(), 2, 0.05, 6);
  expectContains(messageOf<std::invalid_argument>([&] {
                   calibrateStereo(views, {1280, 720}, {9, 6, 0.02});
                 }),
                 "2 of 2 views can be used");
  for (const BoardSize& board : {BoardSize{2, 6, 0.02}, BoardSize{9, 101, 0.02}})
    expectContains(messageOf<std::invalid_argument>([&] {
                     calibrateStereo(views, {1280, 720}, board);
                   }),
                   "board is");
  for (const double square_m : {0.0, -0.02, std::nan("")})
    expectContains(messageOf<std::invalid_argument>([&] {
                     findBoard("v", {}, {}, {9, 6, square_m});
                   }),
                   "square_m");
  const cv::Mat blank(100, 100, CV_8UC1, cv::Scalar(90));
  const cv::Mat bright(100, 100, CV_8UC1, cv::Scalar(200));
  expectContains(findBoard("v", blank, bright, {9, 6, 0.02}).rejected, "either image");
  expectContains(findBoard("v", blank, blank.rowRange(0, 50), {9, 6, 0.02}).rejected, "differ in size");
  expectContains(findBoard("v", blank, {}, {9, 6, 0.02}).rejected, "no 8-bit");
}

// OpenCV's own pictures: 13 pairs, whose result is known from many who calibrated them.
TEST(Calibrate, RealBoards) {
  namespace fs = std::filesystem;
  const char* datasets = std::getenv("POMONA_DATASETS");
  if (!datasets) GTEST_SKIP() << "set POMONA_DATASETS to a folder with calibration-chessboard/";
  const fs::path folder = fs::path(datasets) / "calibration-chessboard";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  std::vector<BoardView> views;
  for (const char* number : {"01", "02", "03", "04", "05", "06", "07", "08", "09", "11", "12", "13", "14"})
    views.push_back(findBoard(number, readImage((folder / ("left" + std::string(number) + ".jpg")).string()),
                              readImage((folder / ("right" + std::string(number) + ".jpg")).string()),
                              {9, 6, 1}));
  const CalibrationReport report = calibrateStereo(views, {640, 480}, {9, 6, 1});
  EXPECT_EQ(report.used_views, 13);
  EXPECT_LE(report.rms_px, 0.22);
  EXPECT_NEAR(report.rig.left.fx_px, 533, 1);
  EXPECT_NEAR(report.rig.baselineM(), 3.33, 0.01);
  EXPECT_LE(report.epipolar_mean_px, 0.2);
}

}  // namespace
}  // namespace pomona
