// What a pixel of a disparity map is, and why.
#pragma once

#include <cstdint>
#include <string_view>

namespace pomona {

/// What a pixel of the disparity map is, and why. Values are stable: they are what `--state` writes to a .pgm
/// (a .png shows them as colours).
enum class PixelState : std::uint8_t {
  kMeasured = 0,  ///< matched, and passed every check

  // Filled: a disparity is present, taken from somewhere else.
  kFilledBackground = 1,    ///< occluded; the background beside it was extended
  kFilledInterpolated = 2,  ///< rejected for another reason; interpolated from measured pixels around it
  kFilledCoarse = 3,        ///< nothing near supported a value; taken from the 1/4- and 1/5-scale maps
  kFilledPlane = 4,         ///< lies on the plane of its colour segment's measured pixels

  // Missing: the disparity is NaN.
  kOccluded = 16,    ///< seen by the left camera only
  kMismatched = 17,  ///< left and right view disagree, but the point should be visible in both
  kAmbiguous = 18,   ///< a second disparity fits almost as well (low or repetitive texture)
  kSpeckle = 19,     ///< part of a region too small to be trusted
  kOutOfRange = 20,  ///< its match lies outside the right image
  kMasked = 21,      ///< excluded by the caller's mask
};

constexpr bool isMeasured(PixelState s) {
  return s == PixelState::kMeasured;
}
constexpr bool isMissing(PixelState s) {
  return s >= PixelState::kOccluded;
}
constexpr bool isFilled(PixelState s) {
  return !isMeasured(s) && !isMissing(s);
}
/// A few lower-case words, e.g. "occluded"; "unknown" for a value outside the enumeration.
std::string_view name(PixelState state);

}  // namespace pomona
