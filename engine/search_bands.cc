#include "engine/search_bands.h"

#include <algorithm>
#include <cmath>

#include "pomona/pixel_state.h"

namespace pomona {
namespace {

int divideUp(int a, int b) {
  return (a + b - 1) / b;
}

}  // namespace

void SearchBands::Interval::add(Interval other) {
  low = std::min(low, other.low);
  high = std::max(high, other.high);
}

void SearchBands::measureTiles(const MatchMaps& look) {
  constexpr int kSide = kTile_px / CoarseLook::kFactor;
  const int width = look.disparity.width(), height = look.disparity.height();
  columns_ = divideUp(width, kSide);
  rows_ = divideUp(height, kSide);
  tiles_.assign(static_cast<std::size_t>(columns_) * rows_, {});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (look.state.row(y)[x] == static_cast<std::uint8_t>(PixelState::kMasked)) continue;
      Tile& tile = tiles_[static_cast<std::size_t>(y / kSide) * columns_ + x / kSide];
      ++tile.pixels;
      if (!look_.hasFound(y, x)) continue;
      const double d = look_.ratio() * look.disparity.row(y)[x];
      ++tile.measured_pixels;
      tile.measured.add(
          {static_cast<int>(std::floor(d)) - kSlack_px, static_cast<int>(std::ceil(d)) + kSlack_px});
    }
}

SearchBands::Interval SearchBands::rangeOfTile(int row, int column) const {
  Interval range;
  int measured = 0, pixels = 0;
  for (int y = std::max(0, row - kReach); y <= std::min(rows_ - 1, row + kReach); ++y)
    for (int x = std::max(0, column - kReach); x <= std::min(columns_ - 1, column + kReach); ++x) {
      const Tile& tile = tiles_[static_cast<std::size_t>(y) * columns_ + x];
      range.add(tile.measured);
      measured += tile.measured_pixels;
      pixels += tile.pixels;
    }
  if (100 * measured < kSurePercent * pixels) return whole_;
  return {std::max(range.low, whole_.low), std::min(range.high, whole_.high)};
}

/// What rounding up to whole vectors adds is slack as well, on both sides.
SearchBand SearchBands::bandOf(int first_row, int end_row, Interval range) const {
  const int y = first_row * kTile_px, end = end_row == rows_ ? height_ : end_row * kTile_px;
  if (range.empty()) range = {whole_.low, whole_.low};
  const int needed = range.high - range.low + 1;
  const int disparities = std::min(divideUp(needed, kLanes) * kLanes, whole_.high - whole_.low + 1);
  const int low =
      std::clamp(range.low - (disparities - needed) / 2, whole_.low, whole_.high + 1 - disparities);
  return {y, end - y, low, disparities};
}

/// In units of what one disparity takes in one row.
std::int64_t SearchBands::timeOf(const SearchBand& band) const {
  constexpr int kOfPixel = 32;  // what a pixel takes besides, whatever its range
  const int begin = std::max(0, band.y - SearchBand::kMargin_px);
  const int end = std::min(height_, band.y + band.height + SearchBand::kMargin_px);
  return std::int64_t{end - begin} * (divideUp(band.disparities, kLanes) * kLanes + kOfPixel);
}

/// The fastest cover of the first n rows of tiles ends with some band: for every n, from 1 up, try them all.
void SearchBands::cutBest() {
  cuts_.assign(static_cast<std::size_t>(rows_) + 1, {});
  for (int end = 1; end <= rows_; ++end) {
    Interval range;
    for (int first = end - 1; first >= 0; --first) {
      range.add(range_of_row_[first]);
      const std::int64_t time = cuts_[first].time + timeOf(bandOf(first, end, range));
      if (first == end - 1 || time < cuts_[end].time) cuts_[end] = {time, first, range};
    }
  }
}

std::span<const SearchBand> SearchBands::plan(const MatchInput& pair, const SparseStage::Settings& settings) {
  // The look has cost some already, and rows that are matched twice cost more than timeOf() counts.
  constexpr int kWorthPercent = 15;
  bands_.clear();
  const int min_disparity = settings.match.min_disparity, disparities = settings.match.disparities;
  if (disparities <= kLanes) return {};
  height_ = pair.left.height;
  whole_ = {min_disparity, min_disparity + disparities - 1};
  // The last disparity of the look stands for those up to kFactor - 1 above it.
  const MatchMaps& look = look_.run(pair, min_disparity, disparities - (CoarseLook::kFactor - 1),
                                    settings.mask, settings.isa, settings.threads);
  measureTiles(look);
  range_of_row_.assign(static_cast<std::size_t>(rows_), {});
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) range_of_row_[row].add(rangeOfTile(row, column));
  cutBest();

  const std::int64_t at_once = timeOf({0, height_, min_disparity, disparities});
  if (100 * cuts_[rows_].time > (100 - kWorthPercent) * at_once) return {};
  for (int end = rows_; end > 0; end = cuts_[end].previous)
    bands_.push_back(bandOf(cuts_[end].previous, end, cuts_[end].range));
  std::reverse(bands_.begin(), bands_.end());
  return bands_;
}

}  // namespace pomona
