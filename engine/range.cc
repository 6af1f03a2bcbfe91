// How many disparities a pair needs, from a quick look at a quarter of its size.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/cpu.h"
#include "core/parallel.h"
#include "engine/input.h"
#include "engine/sparse_stage.h"
#include "pomona/engine.h"
#include "pyramid/scale.h"

namespace pomona {
namespace {

constexpr int kFactor = 4;
constexpr double kIgnoredShare = 0.0005;  // of the measured pixels: outliers that no scene needs
constexpr int kStep = 16;

/// The disparity, in pixels of the small map, that all but the ignored share stay below.
float nearlyLargest(ImageView<const float> map, float otherwise) {
  std::vector<float> known;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      if (!std::isnan(map.at(y, x))) known.push_back(map.at(y, x));
  if (known.empty()) return otherwise;
  const auto at = known.begin() +
                  static_cast<std::ptrdiff_t>(static_cast<double>(known.size() - 1) * (1 - kIgnoredShare));
  std::nth_element(known.begin(), at, known.end());
  return *at;
}

}  // namespace

int estimateNumDisparities(const cv::Mat& left, const cv::Mat& right, const Options& options,
                           const cv::Mat& mask) {
  options.validate();
  const int threads = options.threads > 0 ? options.threads : availableThreads();
  const int min_disparity = options.min_disparity;
  const Isa isa = chooseIsa(options.isa);
  InputPair input;
  input.set(left, right, threads, sgmKernels(isa));
  requireMaskFits(mask, left);
  requireRangeFits(min_disparity, 1, left.cols);

  const int width = scaledLength(left.cols, kFactor), height = scaledLength(left.rows, kFactor);
  const double ratio = static_cast<double>(left.cols) / width;
  Arena scratch;
  Image<std::uint8_t> small[2];
  const ImageView<const std::uint8_t> gray[2] = {input.views().left, input.views().right};
  for (int i = 0; i < 2; ++i) {
    small[i].resize(width, height);
    areaDownscale(GuideView{gray[i].data, gray[i].width, gray[i].height, 1, gray[i].stride}, small[i].view(),
                  scratch, pyramidKernels(isa), threads);
  }

  const Options preset = Options::preset("fast");
  SparseStage::Settings settings;
  settings.match = {static_cast<int>(std::floor(min_disparity / ratio)), std::min(width, kMaxDisparities),
                    preset.cost, preset.aggregation, preset.winner};
  settings.match.winner.uniqueness_percent = 10;
  settings.validation = preset.validation;
  Image<std::uint8_t> small_mask;
  settings.mask = shrunkMask(maskView(mask), width, height, small_mask);
  settings.isa = isa;
  settings.threads = threads;
  settings.scratch = &scratch;
  SparseStage stage;
  StageClock untimed;
  stage.run(
      {small[0].view(), small[1].view(), {}, {}, {small[0].row(0), width, height, 1, small[0].view().stride}},
      settings, untimed);

  const float widest = static_cast<float>(min_disparity + left.cols) / static_cast<float>(ratio);
  const double largest = ratio * nearlyLargest(stage.maps().disparity.view(), widest);
  const int needed =
      static_cast<int>(std::ceil(largest + ratio)) + 1 - min_disparity;  // a coarse pixel of slack
  const int rounded = (std::max(needed, 1) + kStep - 1) / kStep * kStep;
  return std::min({rounded, left.cols, kMaxDisparities});
}

}  // namespace pomona
