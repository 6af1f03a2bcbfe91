// What is noted of one method on one scene, and its mean over scenes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "evaluation/metrics.h"

namespace pomona {

/// Percent, but for kAverageError (pixels). Over the pixels with known truth: "bad" counts holes, "wrong" is
/// the share of the pixels with a disparity.
enum Figure {
  kBad05,
  kBad1,
  kBad2,
  kBad4,
  kWrong05,
  kWrong1,
  kWrong2,
  kWrong4,
  kAverageError,
  kCoverage,
  kFigures
};
inline constexpr std::array<const char*, kFigures> kFigureNames = {
    "bad-0.5", "bad-1", "bad-2", "bad-4", "wrong-0.5", "wrong-1", "wrong-2", "wrong-4", "avg", "coverage"};

/// NaN where a figure is not to be had.
using Figures = std::array<double, kFigures>;

Figures figuresOf(const DisparityErrors& errors);
/// The mean of each figure over those that have it.
Figures meanOf(const std::vector<Figures>& all);

struct SceneFigures {
  std::string scene;
  Figures all;          ///< all pixels with known truth
  Figures nonoccluded;  ///< those seen by both cameras; NaN if the scene comes without that mask
};

struct MethodFigures {
  std::string method;
  bool dense = true;
  std::vector<SceneFigures> scenes;

  /// Each scene counts the same.
  SceneFigures mean() const;
};

}  // namespace pomona
