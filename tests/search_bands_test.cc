// Options::adaptive_range: which bands are searched for which disparities, and what becomes of the map.
#include "engine/search_bands.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/cpu.h"
#include "datasets/named_scenes.h"
#include "datasets/render.h"
#include "engine/input.h"
#include "pomona/engine.h"
#include "result_support.h"

namespace pomona {
namespace {

constexpr int kWidth = 320, kHeight = 384, kNearest = 56, kSearched = 160;

/// Rendered once; a copy, for tests that paint over it.
RenderedPair scene(const std::string& name) {
  static std::map<std::string, RenderedPair> rendered;
  if (!rendered.contains(name)) rendered[name] = render(namedScene(name, 5, kWidth, kHeight, kNearest));
  RenderedPair pair = rendered[name];
  for (RenderedView* view : {&pair.left, &pair.right}) view->image = view->image.clone();
  return pair;
}

/// Nothing to be seen in the lowest 96 rows.
constexpr int kBlankRows = 96;
RenderedPair blankBelow(RenderedPair pair) {
  for (RenderedView* view : {&pair.left, &pair.right})
    view->image.rowRange(kHeight - kBlankRows, kHeight).setTo(cv::Scalar::all(90));
  return pair;
}

class Planner {
 public:
  std::vector<SearchBand> operator()(const RenderedPair& pair, int min_disparity, int disparities,
                                     const cv::Mat& mask = {}, int threads = 2) {
    input_.set(pair.left.image, pair.right.image, threads);
    SparseStage::Settings settings;
    settings.match.min_disparity = min_disparity;
    settings.match.disparities = disparities;
    settings.mask = maskView(mask);
    settings.isa = chooseIsa("");
    settings.threads = threads;
    settings.scratch = &scratch_;
    const std::span<const SearchBand> bands = bands_.plan(input_.views(), settings);
    return {bands.begin(), bands.end()};
  }

 private:
  InputPair input_;
  Arena scratch_;
  SearchBands bands_;
};

Options options(const char* preset, OutputMode mode, bool adaptive = true) {
  Options o = Options::preset(preset);
  o.num_disparities = kSearched;
  o.mode = mode;
  o.adaptive_range = adaptive;
  return o;
}

TEST(SearchBands, CoverTheFrameOnceInsideTheRange) {
  Planner plan;
  for (const char* name : {"boxes", "trees"})
    for (int min_disparity : {-40, 0, 4}) {
      const auto bands = plan(blankBelow(scene(name)), min_disparity, kSearched);
      ASSERT_GE(bands.size(), 2u) << name << ' ' << min_disparity;
      int y = 0;
      for (const SearchBand& band : bands) {
        EXPECT_EQ(band.y, y);
        EXPECT_GT(band.height, 0);
        EXPECT_GE(band.min_disparity, min_disparity);
        EXPECT_GT(band.disparities, 0);
        EXPECT_LE(band.min_disparity + band.disparities, min_disparity + kSearched);
        y += band.height;
      }
      EXPECT_EQ(y, kHeight);
    }
}

TEST(SearchBands, HoldWhatBothViewsSee) {
  Planner plan;
  for (const std::string& name : sceneNames())
    for (int min_disparity : {0, -70}) {
      const RenderedPair pair = scene(name);
      const auto bands = plan(pair, min_disparity, kSearched);
      ASSERT_FALSE(bands.empty()) << name;
      int seen = 0, held = 0, searched = 0;
      for (const SearchBand& band : bands) {
        searched += band.height * band.disparities;
        for (int y = band.y; y < band.y + band.height; ++y)
          for (int x = 0; x < kWidth; ++x) {
            if (pair.left.mask.at<std::uint8_t>(y, x) != 255) continue;
            const float d = pair.left.disparity.at<float>(y, x);
            ++seen;
            held += d >= static_cast<float>(band.min_disparity) &&
                    d <= static_cast<float>(band.min_disparity + band.disparities - 1);
          }
      }
      EXPECT_GT(held, 0.999 * seen) << name;
      EXPECT_LT(searched, 0.85 * kHeight * kSearched) << name;
    }
}

TEST(SearchBands, SearchTheWholeRangeWhereTheLookIsUnsure) {
  Planner plan;
  const RenderedPair pair = blankBelow(scene("boxes"));
  const auto bands = plan(pair, 0, kSearched);
  ASSERT_FALSE(bands.empty());
  EXPECT_LT(bands.front().disparities, kSearched);
  // The first of the three blank rows of tiles has enough above it to go by.
  for (const SearchBand& band : bands)
    if (band.y + band.height > kHeight - kBlankRows + SearchBands::kTile_px) {
      EXPECT_EQ(band.min_disparity, 0);
      EXPECT_EQ(band.disparities, kSearched);
    }

  cv::Mat mask(kHeight, kWidth, CV_8U, cv::Scalar(255));
  mask.rowRange(kHeight - kBlankRows, kHeight).setTo(0);
  for (const SearchBand& band : plan(pair, 0, kSearched, mask))
    EXPECT_LT(band.disparities, kSearched) << "of what is masked nothing has to be found";

  RenderedPair blank = scene("boxes");
  for (RenderedView* view : {&blank.left, &blank.right}) view->image.setTo(cv::Scalar::all(90));
  EXPECT_TRUE(plan(blank, 0, kSearched).empty());
}

TEST(SearchBands, AreNotMadeWhereTheySaveNothing) {
  Planner plan;
  EXPECT_TRUE(plan(scene("boxes"), 0, 64).empty());
  const RenderedPair pair = scene("boxes");
  Options narrow = options("balanced", OutputMode::kDense);
  narrow.num_disparities = 64;
  const StereoResult with = computeDisparity(pair.left.image, pair.right.image, narrow);
  narrow.adaptive_range = false;
  EXPECT_TRUE(sameResult(with, computeDisparity(pair.left.image, pair.right.image, narrow)));
}

TEST(SearchBands, SameBytesForEveryThreadCountAndInstructionSet) {
  const RenderedPair pair = blankBelow(scene("trees"));
  for (const char* preset : {"fast", "quality", "paper"})
    for (OutputMode mode : {OutputMode::kSparse, OutputMode::kDense}) {
      Options o = options(preset, mode);
      if (o.completion.method == CompletionMethod::kPaper && mode == OutputMode::kDense) continue;
      o.threads = 1;
      const StereoResult want = computeDisparity(pair.left.image, pair.right.image, o);
      for (Isa isa : usableIsas())
        for (int threads : {1, 3}) {
          o.isa = name(isa);
          o.threads = threads;
          EXPECT_TRUE(sameResult(computeDisparity(pair.left.image, pair.right.image, o), want))
              << preset << " mode " << static_cast<int>(mode) << ' ' << o.isa << " threads " << threads;
        }
      o.adaptive_range = false;
      EXPECT_FALSE(sameResult(computeDisparity(pair.left.image, pair.right.image, o), want))
          << preset << ": the option does nothing";
    }
}

TEST(SearchBands, AMapIsNoWorseForThem) {
  for (const char* name : {"boxes", "trees"}) {
    const RenderedPair pair = blankBelow(scene(name));
    double bad[2];
    for (bool adaptive : {false, true}) {
      const StereoResult r = computeDisparity(pair.left.image, pair.right.image,
                                              options("balanced", OutputMode::kSparse, adaptive));
      int seen = 0, wrong = 0;
      for (int y = 0; y < kHeight - kBlankRows; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (pair.left.mask.at<std::uint8_t>(y, x) != 255) continue;
          ++seen;
          const float error = r.disparity.at<float>(y, x) - pair.left.disparity.at<float>(y, x);
          wrong += !(std::abs(error) <= 1);  // a hole is NaN
        }
      bad[adaptive] = 1.0 * wrong / seen;
    }
    EXPECT_LT(bad[1], bad[0] + 0.003) << name;
  }
}

/// The seam between two bands of the same range: with margins, the paths of either side know about the other.
TEST(SparseStage, BandsOfTheWholeRangeHardlyChangeTheMap) {
  const RenderedPair pair = scene("spheres");
  InputPair input;
  input.set(pair.left.image, pair.right.image, 2);
  SparseStage::Settings s;
  s.match.disparities = 64;
  s.isa = chooseIsa("");
  s.threads = 2;
  Arena scratch;
  s.scratch = &scratch;
  SparseStage whole, once, twice;
  StageClock untimed;
  whole.run(input.views(), s, untimed);
  once.run(input.views(), s, untimed, std::vector<SearchBand>{{0, kHeight, 0, 64}});
  twice.run(input.views(), s, untimed, std::vector<SearchBand>{{0, 150, 0, 64}, {150, kHeight - 150, 0, 64}});
  const auto different = [&](SparseStage& stage) {
    int n = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const float a = whole.maps().disparity.row(y)[x], b = stage.maps().disparity.row(y)[x];
        n += std::isnan(a) != std::isnan(b) || std::abs(a - b) > 0.25f;
      }
    return n;
  };
  EXPECT_EQ(different(once), 0);
  EXPECT_LE(different(twice), 3);  // without margins: 18
}

TEST(SearchBands, AreRefusedWhereNothingIsMatchedAtFullSize) {
  EXPECT_NO_THROW(options("paper", OutputMode::kSparse).validate());
  try {
    options("paper", OutputMode::kDense).validate();
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("adaptive_range is on"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pomona
