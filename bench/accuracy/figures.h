// What is noted of one method on one scene, and its mean over scenes.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "baselines/method.h"
#include "bench/accuracy/methods.h"

namespace pomona {

/// Over the pixels with known truth, see pomona/evaluation.h. Shares in percent: "bad" counts holes, "wrong"
/// is of the pixels with a disparity. The others are pixels.
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
  kRmsError,
  kErrorQuantile90,
  kErrorQuantile99,
  kCoverage,
  kExcessArea,  ///< of the coverage curve over the oracle's, for errors above 1 px
  kInlierBias,  ///< of errors up to 1 px
  kInlierRms,
  kFigures
};
inline constexpr std::array<const char*, kFigures> kFigureNames = {
    "bad-0.5", "bad-1", "bad-2", "bad-4", "wrong-0.5", "wrong-1",     "wrong-2",     "wrong-4",
    "avg",     "rms",   "A90",   "A99",   "coverage",  "excess-area", "inlier-bias", "inlier-rms"};

/// NaN where a figure is not to be had.
using Figures = std::array<double, kFigures>;

/// `mask`: as for compareWithTruth().
Figures figuresOf(const MethodResult& result, const cv::Mat& truth, const cv::Mat& mask = {});
/// All NaN.
Figures noFigures();
/// The mean of each figure over those that have it.
Figures meanOf(const std::vector<Figures>& all);

struct SceneFigures {
  std::string scene;
  Figures all;          ///< all pixels with known truth
  Figures nonoccluded;  ///< those seen by both cameras; NaN if the scene comes without that mask
};

struct MethodFigures {
  std::string method;  ///< Contender::name()
  MapKind kind = MapKind::kDense;
  std::vector<SceneFigures> scenes;

  /// Each scene counts the same.
  SceneFigures mean() const;
};

}  // namespace pomona
