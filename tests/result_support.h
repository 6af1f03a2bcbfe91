// Whether two frames came out the same, for tests of whole frames.
#pragma once

#include <cstring>
#include <opencv2/core.hpp>

#include "pomona/disparity.h"

namespace pomona {

inline bool sameBytes(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int y = 0; y < a.rows; ++y)
    if (std::memcmp(a.ptr(y), b.ptr(y), a.elemSize() * a.cols) != 0) return false;
  return true;
}

/// All maps, byte by byte.
inline bool sameResult(const StereoResult& a, const StereoResult& b) {
  return sameBytes(a.disparity, b.disparity) && sameBytes(a.state, b.state) &&
         sameBytes(a.confidence, b.confidence) && sameBytes(a.sigma_px, b.sigma_px);
}

}  // namespace pomona
