#include "engine/sparse_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "filters/left_right.h"
#include "filters/median.h"
#include "filters/speckle.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

static_assert(kMostCheckedDisparities >= kMaxDisparities);

/// Ambiguous pixels of row y lose their disparity; so do those the mask excludes.
void removeRejected(MatchMaps& maps, ImageView<const std::uint8_t> mask, int y) {
  const int width = maps.disparity.width();
  std::uint8_t* state = maps.state.row(y);
  if (!mask.empty())
    for (int x = 0; x < width; ++x)
      if (mask.row(y)[x] == 0) state[x] = static_cast<std::uint8_t>(PixelState::kMasked);
  for (int x = 0; x < width; ++x)
    if (state[x] != static_cast<std::uint8_t>(PixelState::kMeasured))
      maps.disparity.row(y)[x] = std::numeric_limits<float>::quiet_NaN();
}

/// The checks that need no other row, while the cache holds this one.
void rejectFromRow(MatchMaps& maps, const SparseStage::Settings& s, int y) {
  if (!s.mask.empty() || s.match.winner.uniqueness_percent > 0) removeRejected(maps, s.mask, y);
  if (s.validation.left_right_px >= 0)
    leftRightCheckRow(
        maps.disparity.row(y), maps.state.row(y), maps.right_disparity.row(y), maps.disparity.width(),
        {s.validation.left_right_px, s.match.min_disparity, s.match.disparities}, filterKernels(s.isa));
}

/// Rows [begin, end) of those columns of the pair.
MatchInput cropped(const MatchInput& pair, int begin, int end, const PartnerColumns& columns) {
  const auto part = [&](auto image, int x, int channels) {
    if (image.data == nullptr) return image;
    image.data = image.row(begin) + x * channels;
    image.width = columns.width;
    image.height = end - begin;
    return image;
  };
  return {part(pair.left, columns.left, 1),
          part(pair.right, columns.right, 1),
          part(pair.left16, columns.left, 1),
          part(pair.right16, columns.right, 1),
          part(pair.guide, columns.left, pair.guide.channels),
          part(pair.prior, columns.left, 1)};
}

}  // namespace

void SparseStage::matchBand(const MatchInput& pair, const Settings& s, const SearchBand& band) {
  const SgmKernels& kernels = sgmKernels(s.isa);
  const int begin = std::max(0, band.y - SearchBand::kMargin_px);
  const int end = std::min(pair.left.height, band.y + band.height + SearchBand::kMargin_px);
  const auto columns = PartnerColumns::of(pair.left.width, band.min_disparity, band.disparities);
  MatchOptions options = s.match;
  options.min_disparity = band.min_disparity;
  options.disparities = band.disparities;
  MatchOptions shifted = options;
  shifted.min_disparity -= columns.shiftPx();
  shifted.prior_shift_px = columns.shiftPx();
  const auto finish = [&](int row, const WinnerRow& winners) {
    const int y = begin + row;
    if (y < band.y || y >= band.y + band.height) return;
    finishRow(winners, y, columns, options, kernels, maps_);
    rejectFromRow(maps_, s, y);
  };
  matcher_.findWinners(cropped(pair, begin, end, columns), shifted, s.mutual_information, kernels, finish,
                       *s.scratch, s.threads);
}

void SparseStage::run(const MatchInput& pair, const Settings& s, StageClock& clock,
                      std::span<const SearchBand> bands) {
  const ValidationOptions& v = s.validation;
  maps_.resize(pair.left.width, pair.left.height);
  const SearchBand whole{0, pair.left.height, s.match.min_disparity, s.match.disparities};
  for (const SearchBand& band : bands.empty() ? std::span(&whole, 1) : bands) matchBand(pair, s, band);
  clock.lap("matching");

  if (v.speckle_size_px > 0)
    removeSpeckles(maps_.disparity.view(), maps_.state.view(), v.speckle_size_px, v.speckle_step_px,
                   *s.scratch, filterKernels(s.isa), s.threads);
  clock.lap("speckle");

  if (v.median_size > 0)
    medianFilter(maps_.disparity.view(), maps_.disparity.view(), v.median_size, filterKernels(s.isa),
                 *s.scratch, s.threads);
  clock.lap("median");
}

MatchOptions scaledOptions(const MatchOptions& full, double ratio, int width) {
  MatchOptions o = full;
  o.min_disparity = static_cast<int>(std::floor(full.min_disparity / ratio));
  const int last = static_cast<int>(std::ceil((full.min_disparity + full.disparities - 1) / ratio));
  o.disparities = std::clamp(last - o.min_disparity + 1, 1, std::min(width, kMaxDisparities));
  return o;
}

}  // namespace pomona
