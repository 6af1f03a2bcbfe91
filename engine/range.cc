// How many disparities a pair needs, from a quick look at a quarter of its size.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/cpu.h"
#include "core/parallel.h"
#include "engine/coarse_look.h"
#include "engine/input.h"
#include "pomona/engine.h"

namespace pomona {
namespace {

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

  CoarseLook look;
  const MatchMaps& maps = look.run(input.views(), min_disparity, left.cols, maskView(mask), isa, threads);
  const double ratio = look.ratio();

  const float widest = static_cast<float>(min_disparity + left.cols) / static_cast<float>(ratio);
  const double largest = ratio * nearlyLargest(maps.disparity.view(), widest);
  const int needed =
      static_cast<int>(std::ceil(largest + ratio)) + 1 - min_disparity;  // a coarse pixel of slack
  const int rounded = (std::max(needed, 1) + kStep - 1) / kStep * kStep;
  return std::min({rounded, left.cols, kMaxDisparities});
}

}  // namespace pomona
