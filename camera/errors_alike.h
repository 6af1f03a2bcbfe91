// How the errors of disparities on one surface hang together.
#pragma once

namespace pomona {

/// Errors of neighbours are alike, for their disparities came of the same costs, paths and smoothing: so many
/// pixels tell as much as one alone would. As rendered orchards have it (docs/measuring.md).
inline constexpr double kAlike_px = 60;
/// The standard deviation of the error that all pixels of a surface have in common: of the sub-pixel curve,
/// of slants, of shading. It does not go down with more pixels.
inline constexpr double kCommonSigma_px = 0.15;
/// No pixel is better than this.
inline constexpr double kSmallestSigma_px = 0.1;

}  // namespace pomona
