// The figures that `pomona eval` notes, once for all its outputs: table, CSV, JSON and report.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/measure.h"

namespace pomona {

/// The pixels that count: all with known truth, or those of them that both cameras see.
enum class Region { kAll, kNonoccluded };
const char* name(Region region);  ///< "all", "nocc"

struct FigureColumn {
  const char* name;         ///< e.g. "bad-2"
  const char* description;  ///< one line, with the unit
  int decimals;
  bool in_terminal;  ///< one of the few for which a terminal has room
  /// NaN where the figure is not to be had. `region` is null where the scene has none of that kind.
  double (*value)(const Measurement& measurement, const RegionFigures* region);
};

std::span<const FigureColumn> figureColumns();

/// One value for each of figureColumns().
std::vector<double> figuresOf(const Measurement& measurement, Region region);

/// The mean of each column over `rows`, without the NaNs. `weights`: empty, or one per row.
std::vector<double> meanOf(const std::vector<std::vector<double>>& rows,
                           std::span<const double> weights = {});

/// "12.34"; "-" for NaN.
std::string shown(double value, int decimals);

}  // namespace pomona
