// The measured vertical offset against offsets that were put in.
#include "camera/row_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <opencv2/imgproc.hpp>

#include "core/cpu.h"
#include "datasets/image_file.h"
#include "datasets/named_scenes.h"
#include "datasets/render.h"
#include "datasets/rendering/named_rigs.h"
#include "datasets/rendering/orchard.h"
#include "pomona/engine.h"

namespace pomona {
namespace {

ImageView<const std::uint8_t> viewOf(const cv::Mat& m) {
  return {m.ptr<std::uint8_t>(), m.cols, m.rows, static_cast<std::ptrdiff_t>(m.step1())};
}

cv::Mat gray(const cv::Mat& image) {
  cv::Mat result;
  cv::cvtColor(image, result, cv::COLOR_BGR2GRAY);
  return result;
}

// The view `shift_px` lower, and turned by `turn` radians about its centre.
cv::Mat moved(const cv::Mat& view, double shift_px, double turn = 0) {
  const double cx = (view.cols - 1) / 2.0, cy = (view.rows - 1) / 2.0, c = std::cos(turn), s = std::sin(turn);
  const cv::Matx23d m(c, -s, cx - c * cx + s * cy, s, c, cy - s * cx - c * cy + shift_px);
  cv::Mat result;
  cv::warpAffine(view, result, m, view.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  return result;
}

// Gray views of a scene; drawing them takes a while, so each size is drawn once.
struct Views {
  cv::Mat left, right;
};
const Views& scene(int width, int height) {
  static std::map<std::pair<int, int>, Views> drawn;
  Views& views = drawn[{width, height}];
  if (views.left.empty()) {
    const RenderedPair pair = render(namedScene("boxes", 3, width, height, width / 10));
    views = {gray(pair.left.image), gray(pair.right.image)};
  }
  return views;
}

RowOffsets measure(const cv::Mat& left, const cv::Mat& right, int min_disparity, int num_disparities) {
  RowCheck check;
  return check.measure(viewOf(left), viewOf(right), min_disparity, num_disparities,
                       cameraKernels(chooseIsa({})), 1);
}

TEST(RowCheck, FindsTheOffsetThatWasPutIn) {
  for (const auto& [width, height, reach] : {std::tuple(1280, 720, 8.0), std::tuple(640, 480, 8.0)})
    for (const double share : {0.0, 0.1, -0.3, 0.75, -0.95}) {
      const Views& views = scene(width, height);
      const double shift_px = share * reach;
      const RowOffsets r = measure(views.left, moved(views.right, shift_px), 0, width / 10);
      EXPECT_NEAR(r.median_px, shift_px, 0.1) << width;
      EXPECT_NEAR(r.worst_px, std::abs(shift_px), 0.35) << width;
      EXPECT_GE(r.points, 30) << width;
    }
}

// One row is half of a reduced one where views are halved, two where they are quartered: all rows of the one
// view then lie between those of the other, and fine texture looks different.
TEST(RowCheck, FindsAsManyPointsHalfwayBetweenReducedRows) {
  cv::RNG random(1);
  for (const auto& [width, height, halfway_px] : {std::tuple(640, 480, 1), std::tuple(1280, 720, 2)}) {
    cv::Mat left(height, width, CV_8U);
    random.fill(left, cv::RNG::UNIFORM, 0, 256);
    cv::GaussianBlur(left, left, {}, 1);
    const cv::Matx23d nearer(1, 0, -20, 0, 1, 0);
    cv::Mat right;
    cv::warpAffine(left, right, nearer, left.size(), cv::INTER_NEAREST, cv::BORDER_REFLECT);
    RowCheck check;
    const auto points = [&, height = height](int shift_px) {
      const cv::Mat lower = moved(right, shift_px);
      const RowOffsets r =
          check.measure(viewOf(left), viewOf(lower), 0, height / 4, cameraKernels(chooseIsa({})), 1, 40);
      EXPECT_NEAR(r.median_px, shift_px, 0.05) << height;
      EXPECT_LT(r.scatter_px, 0.1) << height;
      return r.points;
    };
    for (const int shift_px : {halfway_px, -halfway_px, 7 * halfway_px})
      EXPECT_GE(1.2 * points(shift_px), points(0)) << height << ' ' << shift_px;
  }
}

// The right view with each cell of the check's grid so much lower as `shift_px` says.
template <typename ShiftOf>
cv::Mat movedByCell(const cv::Mat& view, ShiftOf shift_px) {
  constexpr int kColumns = 16, kRows = 10;
  cv::Mat result = view.clone();
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const cv::Rect cell(cv::Point(column * view.cols / kColumns, row * view.rows / kRows),
                          cv::Point((column + 1) * view.cols / kColumns, (row + 1) * view.rows / kRows));
      moved(view, shift_px(column, row))(cell).copyTo(result(cell));
    }
  return result;
}

// As repeated patterns have it: more than half of the matches are off, each by another number of rows.
TEST(RowCheck, GoesByThePointsThatAgree) {
  const Views& views = scene(640, 480);
  const cv::Mat right = movedByCell(views.right, [](int column, int row) {
    return (column + row) % 2 == 0 ? 0 : 1 + (3 * column + row) % 7;
  });
  const RowOffsets r = measure(views.left, right, 0, 64);
  EXPECT_GT(r.scatter_px, 0.25);
  EXPECT_NEAR(r.median_px, 0, 0.2);
  cv::RNG random(1);
  const cv::Mat torn = movedByCell(views.right, [&](int, int) { return random.uniform(-30, 31); });
  RowCheck check;
  const RowOffsets none =
      check.measure(viewOf(views.left), viewOf(torn), 0, 64, cameraKernels(chooseIsa({})), 1, 40);
  EXPECT_GE(none.points, kFewestRowPoints);
  EXPECT_TRUE(std::isnan(none.median_px) && std::isnan(none.worst_px) && std::isnan(none.scatter_px));
}

TEST(RowCheck, LooksAsFarAsItIsTold) {
  const Views& views = scene(640, 480);
  const cv::Mat right = moved(views.right, 23);
  RowCheck check;
  EXPECT_NEAR(
      check.measure(viewOf(views.left), viewOf(right), 0, 64, cameraKernels(chooseIsa({})), 1, 40).median_px,
      23, 0.1);
}

// Leaves: fine texture, of which little is left in views reduced to a quarter.
TEST(RowCheck, FindsTheOffsetOfOrchards) {
  OrchardOptions options;
  options.seed = 5551;
  options.nearest_m = 0.6;
  options.farthest_m = 1.9;
  const RenderedPair pair = render(orchard(sceneFor(namedRig("seed-003")), options).scene);
  const cv::Mat left = gray(pair.left.image), right = gray(pair.right.image);
  for (const double shift_px : {0.0, 2.0, -6.0})
    EXPECT_NEAR(measure(left, moved(right, shift_px), 60, 170).median_px, shift_px, 0.15);
}

TEST(RowCheck, NoticesATurnedCamera) {
  const Views& views = scene(1280, 720);
  const RowOffsets r = measure(views.left, moved(views.right, 0, 0.005), 0, 128);
  EXPECT_LT(std::abs(r.median_px), 1);
  EXPECT_NEAR(r.worst_px, 0.005 * 640, 0.6);
}

TEST(RowCheck, IgnoresExposureAndNegativeDisparities) {
  const cv::Mat left = scene(640, 480).left;
  cv::Mat right = moved(scene(640, 480).right, 1.5);
  right = right * 0.8 + 25;
  EXPECT_NEAR(measure(left, right, 0, 64).median_px, 1.5, 0.15);
  // Exchanged, disparities are negative and the offset has the other sign.
  EXPECT_NEAR(measure(right, left, -64, 64).median_px, -1.5, 0.15);
}

TEST(RowCheck, SaysNothingWithoutTextureOrOverlap) {
  for (const cv::Size size :
       {cv::Size(1, 1), cv::Size(5, 3), cv::Size(33, 17), cv::Size(300, 9), cv::Size(640, 480)}) {
    const cv::Mat flat(size, CV_8UC1, cv::Scalar(100));
    const RowOffsets r = measure(flat, flat, 0, 64);
    EXPECT_TRUE(std::isnan(r.median_px) && std::isnan(r.worst_px)) << size;
    EXPECT_EQ(r.points, 0);
  }
  cv::Mat a(480, 640, CV_8UC1), b(480, 640, CV_8UC1);
  cv::RNG random(1);
  random.fill(a, cv::RNG::UNIFORM, 0, 256);
  random.fill(b, cv::RNG::UNIFORM, 0, 256);
  EXPECT_TRUE(std::isnan(measure(a, b, 0, 64).median_px));  // different noise: no match
}

TEST(RowCheck, KeepsNothingFromTheFrameBefore) {
  const auto& [left, right] = scene(640, 480);
  RowCheck check;
  const RowOffsets first = check.measure(viewOf(left), viewOf(right), 0, 64, cameraKernels(chooseIsa({})), 1);
  check.measure(viewOf(right), viewOf(left), -64, 64, cameraKernels(chooseIsa({})), 1);
  const RowOffsets again = check.measure(viewOf(left), viewOf(right), 0, 64, cameraKernels(chooseIsa({})), 1);
  EXPECT_EQ(first.median_px, again.median_px);
  EXPECT_EQ(first.worst_px, again.worst_px);
  EXPECT_EQ(first.points, again.points);
}

TEST(RowCheck, IsTheSameOnEveryInstructionSetAndForEveryThreadCount) {
  for (const auto& [width, height] : {std::pair(1281, 720), std::pair(643, 480), std::pair(350, 240)}) {
    const auto& [left, right] = scene(width, height);
    RowCheck check;
    const RowOffsets expected =
        check.measure(viewOf(left), viewOf(right), 0, width / 10, cameraKernels(Isa::kScalar), 1);
    EXPECT_GE(expected.points, 10);
    for (const Isa isa : usableIsas()) {
      for (const int threads : {1, 2, 16}) {
        const RowOffsets r =
            check.measure(viewOf(left), viewOf(right), 0, width / 10, cameraKernels(isa), threads);
        EXPECT_EQ(r.median_px, expected.median_px) << name(isa) << ' ' << width << ' ' << threads;
        EXPECT_EQ(r.worst_px, expected.worst_px) << name(isa) << ' ' << width << ' ' << threads;
        EXPECT_EQ(r.points, expected.points) << name(isa) << ' ' << width << ' ' << threads;
      }
    }
  }
}

TEST(RowCheck, EngineWarnsUnlessToldNotTo) {
  const auto& [left, right] = scene(640, 480);
  Options options = Options::preset("fast");
  options.num_disparities = 64;
  options.mode = OutputMode::kSparse;
  StereoEngine engine(options);
  EXPECT_FALSE(engine.compute(left, right).rowsAreOff());
  const cv::Mat off = moved(right, 2);
  const StereoResult& result = engine.compute(left, off);
  EXPECT_NEAR(result.row_offset_px, 2, 0.1);
  EXPECT_TRUE(result.rowsAreOff());
  const float offset_px = result.row_offset_px, error_px = result.row_error_px;
  for (const char* isa : {"scalar", ""})
    for (const int threads : {1, 3}) {
      options.isa = isa;
      options.threads = threads;
      StereoEngine other(options);
      const StereoResult& r = other.compute(left, off);
      EXPECT_EQ(r.row_offset_px, offset_px);
      EXPECT_EQ(r.row_error_px, error_px);
    }
  options.align_rows = false;
  StereoEngine unmoved(options);
  options.row_check = false;
  StereoEngine silent(options);
  const StereoResult& unchecked = silent.compute(left, off);
  EXPECT_TRUE(std::isnan(unchecked.row_offset_px));
  EXPECT_FALSE(unchecked.rowsAreOff());
  EXPECT_EQ(cv::norm(unchecked.state, unmoved.compute(left, off).state, cv::NORM_INF), 0);
}

// Where they drown the texture, the offset is unknown, not wrong.
TEST(RowCheck, HotPixelsDoNotMislead) {
  const auto& [left, right] = scene(640, 480);
  cv::RNG random(4);
  for (const double contrast : {1.0, 0.25, 0.1})
    for (const int hot : {300, 1000, 3000}) {
      cv::Mat views[2] = {left * contrast, right * contrast};
      for (cv::Mat& view : views)
        for (int i = 0; i < hot; ++i)
          view.at<std::uint8_t>(random.uniform(0, view.rows), random.uniform(0, view.cols)) = 255;
      const RowOffsets r = measure(views[0], views[1], 0, 64);
      SCOPED_TRACE(::testing::Message() << "contrast " << contrast << ", " << hot << " hot pixels");
      EXPECT_TRUE(std::isnan(r.median_px) || (std::abs(r.median_px) < 0.15 && r.worst_px < 0.5))
          << r.median_px << ' ' << r.worst_px;
    }
}

TEST(RowCheck, RealPairsAreAligned) {
  namespace fs = std::filesystem;
  const char* datasets = std::getenv("POMONA_DATASETS");
  if (!datasets) GTEST_SKIP() << "set POMONA_DATASETS to a folder with middlebury/";
  const fs::path folder = fs::path(datasets) / "middlebury";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  for (const char* scene : {"Motorcycle", "Aloe-full", "Aloe", "Cloth1", "teddy", "Art", "Reindeer"}) {
    const cv::Mat left = gray(readImage((folder / scene / "im0.png").string()));
    const cv::Mat right = gray(readImage((folder / scene / "im1.png").string()));
    for (const double shift_px : {0.0, 1.0, 2.0})
      for (const int reach_px : {8, 40}) {
        const cv::Mat lower = moved(right, shift_px);
        RowCheck check;
        const RowOffsets r = check.measure(viewOf(left), viewOf(lower), 0, left.cols / 4,
                                           cameraKernels(chooseIsa({})), 1, reach_px);
        EXPECT_NEAR(r.median_px, shift_px, 0.25) << scene << ' ' << reach_px;
        EXPECT_GE(r.points, 25) << scene << ' ' << reach_px;
      }
  }
}

}  // namespace
}  // namespace pomona
