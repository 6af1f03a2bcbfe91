// The methods that are compared: Pomona's presets, and OpenCV as the peer to beat.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace pomona {

struct Method {
  std::string name;  ///< e.g. "balanced dense"
  bool dense;        ///< fills every pixel; else only what it measured
  /// Dense and sparse alike must be no worse than the peer of their kind. Not asked of the peer itself, nor
  /// of the `paper` preset, which reproduces a baseline.
  bool must_match_peer;
  /// Left and right view and the number of disparities, from 0 up, to CV_32F; NaN where unknown.
  std::function<cv::Mat(const cv::Mat&, const cv::Mat&, int)> match;
};

inline constexpr const char* kPeer = "opencv-hh";

/// In the order of the tables, each once dense and once sparse.
std::vector<Method> accuracyMethods();

}  // namespace pomona
