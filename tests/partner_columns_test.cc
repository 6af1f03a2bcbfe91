// Ranges that leave columns without a partner: these are out of range, and all others matched as if they
// were not there.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/cpu.h"
#include "datasets/named_scenes.h"
#include "datasets/render.h"
#include "engine/input.h"
#include "engine/sparse_stage.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

constexpr int kWidth = 150, kHeight = 60, kDisparities = 24;

class Stage {
 public:
  /// Winners as they are; drawn to `prior`, if there is one.
  const MatchMaps& run(const cv::Mat& left, const cv::Mat& right, int min_disparity, const cv::Mat1f& prior) {
    input_.set(left, right, 2);
    MatchInput pair = input_.views();
    SparseStage::Settings s;
    s.match.min_disparity = min_disparity;
    s.match.disparities = kDisparities;
    s.validation.left_right_px = -1;
    s.validation.speckle_size_px = s.validation.median_size = 0;
    s.isa = chooseIsa("");
    s.threads = 2;
    s.scratch = &scratch_;
    if (!prior.empty()) {
      pair.prior = {prior[0], prior.cols, prior.rows, static_cast<std::ptrdiff_t>(prior.step1())};
      s.match.prior_weight = 3;
      s.match.prior_reach_px = 4;
    }
    StageClock clock;
    stage_.run(pair, s, clock);
    return stage_.maps();
  }

 private:
  InputPair input_;
  Arena scratch_;
  SparseStage stage_;
};

void expectEqualToTheRest(int min_disparity, bool has_prior) {
  SCOPED_TRACE(testing::Message() << "from " << min_disparity << ", prior " << has_prior);
  const RenderedPair pair = render(namedScene("boxes", 3, kWidth, kHeight, 20));
  const int last = min_disparity + kDisparities - 1;
  const int left = std::max(0, min_disparity), right = std::max(0, -last), shift = left - right;
  const int width = kWidth - left - right;
  cv::Mat1f prior;
  if (has_prior) prior = pair.left.disparity + shift;
  const auto part = [&](const cv::Mat& view, int begin) {
    return cv::Mat(view.empty() ? view : view.colRange(begin, begin + width));
  };

  Stage whole_stage, part_stage;
  const MatchMaps& whole = whole_stage.run(pair.left.image, pair.right.image, min_disparity, prior);
  const cv::Mat1f shifted = has_prior ? cv::Mat1f(part(prior, left) - shift) : cv::Mat1f();
  const MatchMaps& rest = part_stage.run(part(pair.left.image, left), part(pair.right.image, right),
                                         min_disparity - shift, shifted);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const int in_left = x - left, in_right = x - right;
      if (in_left < 0 || in_left >= width) {
        ASSERT_TRUE(std::isnan(whole.disparity.row(y)[x])) << x << ' ' << y;
        ASSERT_EQ(whole.state.row(y)[x], static_cast<std::uint8_t>(PixelState::kOutOfRange));
      } else {
        ASSERT_NEAR(whole.disparity.row(y)[x], rest.disparity.row(y)[in_left] + shift, 1e-4) << x << ' ' << y;
        ASSERT_EQ(whole.margin(y)[x], rest.margin(y)[in_left]);
        ASSERT_EQ(whole.curvature(y)[x], rest.curvature(y)[in_left]);
        ASSERT_EQ(whole.state.row(y)[x], rest.state.row(y)[in_left]);
      }
      const float got = whole.right_disparity.row(y)[x];
      const float want = in_right < 0 || in_right >= width
                             ? std::numeric_limits<float>::quiet_NaN()
                             : rest.right_disparity.row(y)[in_right] + static_cast<float>(shift);
      ASSERT_TRUE((std::isnan(got) && std::isnan(want)) || std::abs(got - want) < 1e-4) << x << ' ' << y;
    }
}

TEST(PartnerColumns, AreMatchedAsIfTheOthersWereNotThere) {
  for (int min_disparity : {1, 9, 140, -24, -40})
    for (bool has_prior : {false, true}) expectEqualToTheRest(min_disparity, has_prior);
}

TEST(PartnerColumns, AreAllOfThemWhereTheRangeHoldsZero) {
  for (int min_disparity : {0, -1, -5, -kDisparities + 1}) {
    const PartnerColumns all = PartnerColumns::of(kWidth, min_disparity, kDisparities);
    EXPECT_EQ(all.width, kWidth) << min_disparity;
    EXPECT_EQ(all.shiftPx(), 0) << min_disparity;
  }
}

}  // namespace
}  // namespace pomona
