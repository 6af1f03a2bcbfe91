// Everything one run of `pomona eval` found, and its outputs as text: CSV and JSON.
#pragma once

#include <string>
#include <vector>

#include "apps/figure_columns.h"

namespace pomona {

struct EvalRecord {
  struct Fact {
    std::string name, value;
  };
  std::vector<Fact> facts;  ///< machine, versions and options: what the figures depend on
  std::vector<std::string> methods;
  std::vector<Measurement> measurements;  ///< scene by scene, within a scene in the order of `methods`
  std::vector<std::string> problems;      ///< what could not be measured, and why
  std::vector<std::string> remarks;       ///< what else to know about the figures
  Region region = Region::kAll;           ///< what the table and the report show first
  bool weighted = false;                  ///< means use Middlebury's weights

  /// The mean of each column over the scenes; scenes without the figure are left out.
  std::vector<double> meanOfMethod(const std::string& method, Region over) const;
  /// How many scenes are behind it: those with errors over the region.
  int scenesBehindMean(const std::string& method, Region over) const;
};

/// A line per scene, method and region, with a header. Figures that are not to be had are empty.
std::string csvOf(const EvalRecord& record);

/// {"facts": {...}, "columns": {name: description}, "scenes": [{"scene", "method", "width", "height",
/// "num_disparities", "all": {column: value}, "nocc": {...}, "curve": [[coverage, wrong, oracle]],
/// "subpixel":
/// [[inliers, bias, rms]]}], "means": {method: {"all": {"scenes": number of scenes, column: value}, "nocc":
/// {...}}}, "problems": [...], "remarks": [...]}. Figures that are not to be
/// had are left out.
std::string jsonOf(const EvalRecord& record);

}  // namespace pomona
