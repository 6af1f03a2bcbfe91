// Adaptive support weights: K.-J. Yoon, I.-S. Kweon: Adaptive support-weight approach for correspondence
// search. IEEE TPAMI 28(4), 2006.
#pragma once

#include <opencv2/core.hpp>

#include "baselines/winner.h"
#include "core/cpu.h"

namespace pomona {

inline constexpr int kLargestAswRadius = 31;

/// The defaults are tuned on Middlebury's v2 pairs; docs/algorithms.md compares them with the printed gamma_c
/// 7, gamma_p 36, T 40.
struct AswOptions {
  int radius = 17;                ///< the window's side is 2 radius + 1; 1 to kLargestAswRadius
  float color_gamma = 20;         ///< CIELab units (gamma_c); > 0
  float proximity_gamma = 17.5f;  ///< pixels (gamma_p); > 0
  float truncation = 60;          ///< largest raw cost, sum over three channels of 8 bits (T)
};

/// The support weight of a pixel q for the centre p of its window is, in either view,
///     w(p, q) = exp(-|Lab(p) - Lab(q)| / gamma_c - |p - q| / gamma_p),
/// and the cost the mean of the raw costs min(sum over channels |left(q) - right(q - d)|, T) over the window,
/// weighted by the product of the weights in both views: exactly, every weight of every window. Windows end
/// at the views' borders.
///
/// The views have equal size and type, CV_8U or CV_16U (brought to 8-bit units) with 1 or 3 channels; a gray
/// view counts as one with three equal channels. Throws std::invalid_argument for options outside their
/// range.
WindowMaps matchAsw(const cv::Mat& left, const cv::Mat& right, const AswOptions& options, SearchRange range,
                    WinnerPosition position, Isa isa, int threads);

}  // namespace pomona
