// Rows moved to where they match: the resampling, when it is done, and what it saves.
#include "camera/row_align.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "core/cpu.h"
#include "datasets/named_scenes.h"
#include "datasets/render.h"
#include "pomona/engine.h"
#include "result_support.h"

namespace pomona {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

template <typename T>
ImageView<const T> viewOf(const cv::Mat& m) {
  return {m.ptr<T>(), m.cols, m.rows, static_cast<std::ptrdiff_t>(m.step1())};
}

/// Keys' kernel at a place rounded to 1/64 px, as the header has it.
template <typename T>
double twin(const cv::Mat& view, int x, double y) {
  const auto kernel = [](double t) {
    t = std::abs(t);
    return t <= 1 ? (1.5 * t - 2.5) * t * t + 1 : t < 2 ? ((-0.5 * t + 2.5) * t - 4) * t + 2 : 0.0;
  };
  y = std::round(64 * y) / 64;
  double sum = 0;
  for (int row = static_cast<int>(std::floor(y)) - 1; row <= std::floor(y) + 2; ++row)
    sum += kernel(y - row) * view.at<T>(std::clamp(row, 0, view.rows - 1), x);
  return std::clamp(sum, 0.0, double{std::numeric_limits<T>::max()});
}

template <typename T>
void expectTwin(int type, double tolerance) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(7, 3), cv::Size(65, 40)})
    for (const RowOffsetPlane& offset :
         {RowOffsetPlane{0.5f, 0, 0}, RowOffsetPlane{-2.3f, 0, 0}, RowOffsetPlane{0.1f, 1.7f, -0.6f}}) {
      cv::Mat poisoned(size.height, size.width + 5, type, cv::Scalar(77));
      cv::Mat view = poisoned.colRange(2, 2 + size.width);
      cv::RNG(9).fill(view, cv::RNG::UNIFORM, 0, double{std::numeric_limits<T>::max()} + 1);
      for (const Isa isa : usableIsas()) {
        const int threads = isa == Isa::kScalar ? 1 : 3;
        Image<T> out;
        alignRows<T>(viewOf<T>(view), offset, out, cameraKernels(isa), threads);
        ASSERT_EQ(out.width(), size.width);
        ASSERT_EQ(out.height(), size.height);
        for (int y = 0; y < size.height; ++y)
          for (int x = 0; x < size.width; ++x)
            ASSERT_NEAR(out.row(y)[x], twin<T>(view, x, y + offset.at(x, y, size.width, size.height)),
                        tolerance)
                << size << ' ' << offset.center_px << " at " << x << ", " << y;
      }
    }
}

TEST(AlignRows, InterpolatesLikeItsTwin) {
  expectTwin<std::uint8_t>(CV_8UC1, 0.6);
  expectTwin<std::uint16_t>(CV_16UC1, 30);  // weights are rounded to 1/4096
}

TEST(AlignRows, MovesByWholeRowsExactly) {
  cv::Mat view(20, 30, CV_8U);
  cv::randu(view, 0, 256);
  Image<std::uint8_t> out;
  alignRows<std::uint8_t>(viewOf<std::uint8_t>(view), {3, 0, 0}, out, cameraKernels(chooseIsa({})), 1);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 30; ++x)
      ASSERT_EQ(out.row(y)[x], view.at<std::uint8_t>(std::min(y + 3, 19), x));  // the last row repeats
}

TEST(RowCorrection, FollowsWhatThePointsAgreeOn) {
  const auto of = [](float median_px, RowOffsetPlane plane, float scatter_px) {
    return rowCorrection({median_px, 0, 40, plane, scatter_px});
  };
  EXPECT_FALSE(of(0.08f, {0.08f, 0.1f, 0.1f}, 0.05f));  // within what the check can tell
  EXPECT_FALSE(of(2, {2, 0, 0}, 0.4f));                 // in disagreement
  EXPECT_FALSE(of(2, {2, 0, 0}, kNan));
  EXPECT_FALSE(rowCorrection({kNan, kNan, 3, {kNan, kNan, kNan}, kNan}));
  const auto moved = of(-0.5f, {-0.4f, 0.2f, 0.2f}, 0.05f);
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->center_px, -0.5f);
  EXPECT_EQ(moved->slope_x_px, 0);
  EXPECT_EQ(moved->slope_y_px, 0);
  const auto turned = of(0, {0.02f, 0.1f, -0.9f}, 0.05f);
  ASSERT_TRUE(turned);
  EXPECT_EQ(turned->center_px, 0.02f);
  EXPECT_EQ(turned->slope_x_px, 0.1f);
  EXPECT_EQ(turned->slope_y_px, -0.9f);
}

/// Down by `shift_px`, and by `shear_px` more at the right border, as much less at the left one: a camera
/// that is turned, but for what the turn does to disparities.
cv::Mat moved(const cv::Mat& view, double shift_px, double shear_px = 0) {
  const double slope = 2 * shear_px / view.cols;
  const cv::Matx23d m(1, 0, 0, slope, 1, shift_px - shear_px);
  cv::Mat result;
  cv::warpAffine(view, result, m, view.size(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return result;
}

const RenderedPair& boxes() {
  static const RenderedPair pair = render(namedScene("boxes", 3, 480, 320, 48));
  return pair;
}

Options optionsOf(const char* preset, bool align = true) {
  Options o = Options::preset(preset);
  o.num_disparities = 64;
  o.align_rows = align;
  return o;
}

double badPercent(const StereoResult& result) {
  const cv::Mat& truth = boxes().left.disparity;
  int bad = 0;
  for (int y = 0; y < truth.rows; ++y)
    for (int x = 0; x < truth.cols; ++x)
      bad += !(std::abs(result.disparity.at<float>(y, x) - truth.at<float>(y, x)) <= 1);
  return 100.0 * bad / static_cast<double>(truth.total());
}

TEST(AlignedRows, PairsThatAreOffComeBack) {
  const auto& [left, right] = std::tie(boxes().left.image, boxes().right.image);
  for (const char* preset : {"fast", "balanced", "quality"}) {
    const double unmoved = badPercent(computeDisparity(left, right, optionsOf(preset)));
    for (const auto& [shift_px, shear_px] :
         {std::pair(0.5, 0.0), std::pair(1.0, 0.0), std::pair(-2.0, 0.0), std::pair(0.3, 1.2)}) {
      SCOPED_TRACE(::testing::Message() << preset << ' ' << shift_px << ' ' << shear_px);
      const cv::Mat off = moved(right, shift_px, shear_px);
      const StereoResult aligned = computeDisparity(left, off, optionsOf(preset));
      const StereoResult as_it_is = computeDisparity(left, off, optionsOf(preset, false));
      EXPECT_TRUE(aligned.rows_aligned);
      EXPECT_FALSE(as_it_is.rows_aligned);
      EXPECT_EQ(aligned.row_offset_px, as_it_is.row_offset_px);  // stays the measured one
      EXPECT_LT(badPercent(aligned), unmoved + 0.7);
      EXPECT_GT(badPercent(as_it_is), badPercent(aligned) + 0.7);
    }
  }
}

TEST(AlignedRows, AlignedPairsStayToTheByte) {
  const auto& [left, right] = std::tie(boxes().left.image, boxes().right.image);
  for (const char* preset : {"fast", "balanced", "quality"}) {
    const StereoResult checked = computeDisparity(left, right, optionsOf(preset));
    ASSERT_GE(std::abs(checked.row_offset_px), 0);  // not NaN
    EXPECT_FALSE(checked.rows_aligned);
    EXPECT_TRUE(sameResult(checked, computeDisparity(left, right, optionsOf(preset, false))));
  }
}

TEST(AlignedRows, NothingMovesWithoutACorrectOffset) {
  cv::Mat noise_left(200, 320, CV_8UC3), noise_right(200, 320, CV_8UC3);
  cv::RNG random(5);
  random.fill(noise_left, cv::RNG::UNIFORM, 0, 256);
  random.fill(noise_right, cv::RNG::UNIFORM, 0, 256);
  EXPECT_FALSE(computeDisparity(noise_left, noise_right, optionsOf("fast")).rows_aligned);
  cv::Mat stripes(200, 320, CV_8UC3), lower;  // any number of periods is as good as any other
  for (int y = 0; y < stripes.rows; ++y) stripes.row(y) = cv::Scalar::all(y % 6 < 3 ? 60 : 190);
  lower = moved(stripes, 1);
  EXPECT_FALSE(computeDisparity(stripes, lower, optionsOf("fast")).rows_aligned);
  const cv::Mat flat(200, 320, CV_8UC3, cv::Scalar::all(90));
  EXPECT_FALSE(computeDisparity(flat, flat, optionsOf("fast")).rows_aligned);
}

TEST(AlignedRows, SameBytesForEveryThreadCountAndInstructionSet) {
  cv::Mat left, right;
  boxes().left.image.convertTo(left, CV_16U, 250);
  moved(boxes().right.image, 0.7, 0.9).convertTo(right, CV_16U, 250);
  Options o = optionsOf("balanced");
  o.threads = 1;
  o.isa = "scalar";
  const StereoResult want = computeDisparity(left, right, o);
  EXPECT_TRUE(want.rows_aligned);
  for (Isa isa : usableIsas())
    for (const int threads : {1, 3}) {
      o.isa = name(isa);
      o.threads = threads;
      EXPECT_TRUE(sameResult(computeDisparity(left, right, o), want)) << o.isa << ' ' << threads;
    }
}

}  // namespace
}  // namespace pomona
