// Walks the paths of a sweep over rows, on one thread or on several.
//
// Pixel (x, y) of a sweep needs what its paths carry from (x - 1, y) and from (x - 1 .. x + 1) of the row
// before. So the rows are cut into groups, one thread takes a group, and each group follows the one before it
// through the image, some pixels behind. A group goes forward in tiles: so many columns of all its rows, the
// columns of each row one less far than those of the row before. Everything that a tile needs is then done
// once the group before is two tiles ahead, what the paths carry lies in the cache for all rows of the tile,
// and the only thing that threads wait for is the progress of the group before.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/arena.h"
#include "core/parallel.h"
#include "sgm/aggregation.h"
#include "sgm/sweep_plan.h"

namespace pomona {

/// Rows that follow one another.
struct RowRun {
  int y;     ///< the first
  int step;  ///< to the next: 1, or -1
  int count;
  std::uint8_t* sums;     ///< of the first row; null: they are of no use to anybody
  std::ptrdiff_t stride;  ///< bytes from its sums to those of the next row
};

/// One sweep, and the memory of the threads that work on it.
class Sweep {
 public:
  /// For up to `threads` threads. Takes memory from the current scope of `arena`.
  Sweep(const SweepPlan& plan, Arena& arena, int threads);

  /// Paths begin anew with the next row.
  static void clear(const SweepPlan& plan, std::uint8_t* state);
  /// Left to right; leaves the sums of the paths.
  void advance(const RowRun& run, std::uint8_t* state);
  /// Right to left; completes the sums and hands the winners on.
  void complete(const RowRun& run, std::uint8_t* state, WinnerSink sink);

 private:
  struct Lane;  // the memory of one thread
  struct Walk;
  void walk(const RowRun& run, std::uint8_t* state, const WinnerSink* sink);
  void walkGroup(const Walk& walk, int group);
  Lane& enterLane();  // one that no other thread is in; there are as many as threads

  const SweepPlan& plan_;
  int threads_, group_rows_;
  Lane* lanes_;
  TaskProgress* progress_ = nullptr;  // of each group
};

}  // namespace pomona
