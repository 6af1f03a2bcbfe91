// The fruits of one picture, measured in several ways from one method's map.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/fruits/distance_errors.h"
#include "bench/fruits/orchard_picture.h"
#include "pomona/disparity.h"

namespace pomona {

enum Way : int {
  kMask,     ///< measureObject() with a mask of the visible pixels: the near side
  kVisible,  ///< ... with the box of these
  kBox,      ///< ... with a detector's box: that of the whole outline, each side off by up to a tenth
  kCenter,   ///< the centre, with the mask
  /// No sphere: the median of the mask's distances, against the median of their true ones.
  kMedian,
  kWays
};
inline constexpr const char* kWayNames[kWays] = {"mask", "visible box", "detector's box", "centre", "median"};

using WaysOfOneFruit = std::array<MeasuredDistance, kWays>;

/// One for each of picture.fruits. `seed` is for the boxes that are off: the same for the same seed.
std::vector<WaysOfOneFruit> measureFruits(const StereoResult& result, const OrchardPicture& picture,
                                          std::uint64_t seed);

/// The map of a method of the registry. Pomona's presets but `paper` come with their confidence and sigma,
/// all others with disparities and states alone: their pixels count as equally sure, filled ones for a
/// quarter. Throws std::invalid_argument for an unknown method.
StereoResult mapOf(const std::string& method, const cv::Mat& left, const cv::Mat& right, int num_disparities);
/// Whether mapOf() comes with sigma.
bool knowsSigma(const std::string& method);

}  // namespace pomona
