// A range that follows the scene: bands of rows, each searched for the disparities that a coarse look has
// found in it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/coarse_look.h"

namespace pomona {

/// Why bands, and not blocks of any shape: a row is matched as a whole, so that the right view, whose matches
/// come from all of the row, is what it would be without bands (docs/benchmarking.md has the figures).
class SearchBands {
 public:
  /// Bands that cover the frame once, top to bottom, each with a range inside that of `settings.match`; none
  /// if the frame matched at once is about as fast. Valid until the next call.
  ///
  /// The frame is divided into tiles of kTile_px. What a tile has to be searched for is what a coarse look
  /// has measured in it and in those up to kReach tiles away, and kSlack_px on both sides; but the whole
  /// range, unless it measured at least kSurePercent of the pixels there that the mask leaves. The range of a
  /// band holds those of all its tiles. Ranges of kLanes or fewer disparities are not divided.
  std::span<const SearchBand> plan(const MatchInput& pair, const SparseStage::Settings& settings);

  static constexpr int kTile_px = 32;
  static constexpr int kReach = 2;
  static constexpr int kSlack_px = 8;
  static constexpr int kSurePercent = 25;
  /// Disparities in a vector of the widest CPU: fewer take no less time there. On all others, too, ranges are
  /// multiples of it, for the plan decides about results.
  static constexpr int kLanes = 64;

 private:
  /// Whole disparities, both ends included; empty to begin with.
  struct Interval {
    int low = 1 << 20, high = -(1 << 20);
    bool empty() const { return low > high; }
    void add(Interval other);
  };
  struct Tile {
    Interval measured;  // with slack
    int measured_pixels, pixels;
  };
  struct Cut {  // the best cover of the rows above
    std::int64_t time;
    int previous;
    Interval range;
  };
  void measureTiles(const MatchMaps& look);
  Interval rangeOfTile(int row, int column) const;
  SearchBand bandOf(int first_row, int end_row, Interval range) const;
  std::int64_t timeOf(const SearchBand& band) const;
  void cutBest();

  CoarseLook look_;
  int height_ = 0;
  int rows_ = 0, columns_ = 0;  // of tiles
  Interval whole_;
  std::vector<Tile> tiles_;
  std::vector<Interval> range_of_row_;  // of tiles
  std::vector<Cut> cuts_;               // one more than rows of tiles
  std::vector<SearchBand> bands_;
};

}  // namespace pomona
