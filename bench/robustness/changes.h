// What may differ between the two cameras of a rig, done to the right view of a perfect pair.
#pragma once

#include <opencv2/core.hpp>
#include <span>

namespace pomona {

struct Change {
  const char* name;
  /// The changed form of a view, CV_8U with 1 or 3 channels; values are rounded and kept within 0..255. The
  /// same view gives the same bytes.
  cv::Mat (*apply)(const cv::Mat& view);
};

/// The first changes nothing.
std::span<const Change> changes();

}  // namespace pomona
