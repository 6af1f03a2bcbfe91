// How far a disparity map is from the truth, counted as the Middlebury benchmark counts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>

namespace pomona {

/// Errors above these many pixels are counted ("bad-0.5" and so on).
inline constexpr std::array<float, 4> kBadThresholds_px = {0.5f, 1.0f, 2.0f, 4.0f};

/// Counts over the pixels whose truth is known. Shares are in percent, and NaN where there is nothing to
/// share.
struct DisparityErrors {
  std::int64_t known = 0;                                      ///< pixels compared
  std::int64_t holes = 0;                                      ///< of these, without a disparity
  std::array<std::int64_t, kBadThresholds_px.size()> wrong{};  ///< with one, off by more than the threshold
  double error_sum_px = 0;  ///< sum of |d - truth| over pixels with a disparity

  /// Pixels that are wrong or a hole, of all known ones. `threshold` is an index into kBadThresholds_px.
  double badPercent(std::size_t threshold) const;
  /// Pixels that are wrong, of those with a disparity: how far a sparse map can be trusted.
  double wrongPercent(std::size_t threshold) const;
  /// Pixels with a disparity, of all known ones.
  double coveragePercent() const;
  /// Mean |d - truth| over pixels with a disparity.
  double averageErrorPx() const;
};

/// Compares `disparity` with `truth` (both CV_32F, of one size; a value that is not finite is unknown).
/// A pixel is wrong if |d - truth| > threshold, strictly. `mask`: empty, or CV_8U of the same size; only
/// pixels of value 255 count (in Middlebury's mask0nocc: visible in both views). Throws std::invalid_argument
/// if sizes or types differ from this.
DisparityErrors compareWithTruth(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& mask = {});

}  // namespace pomona
