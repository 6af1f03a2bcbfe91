#include "pomona/pixel_state.h"

namespace pomona {

std::string_view name(PixelState state) {
  switch (state) {
    case PixelState::kMeasured:
      return "measured";
    case PixelState::kFilledBackground:
      return "filled from the background";
    case PixelState::kFilledInterpolated:
      return "interpolated";
    case PixelState::kFilledCoarse:
      return "filled from the coarse maps";
    case PixelState::kFilledPlane:
      return "filled from a plane";
    case PixelState::kOccluded:
      return "occluded";
    case PixelState::kMismatched:
      return "mismatched";
    case PixelState::kAmbiguous:
      return "ambiguous";
    case PixelState::kSpeckle:
      return "speckle";
    case PixelState::kOutOfRange:
      return "out of range";
    case PixelState::kMasked:
      return "masked";
  }
  return "unknown";
}

}  // namespace pomona
