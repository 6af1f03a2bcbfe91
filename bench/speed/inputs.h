// What is matched: a real pair, at any size.
#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

namespace pomona {

/// Frames that are not measured: memory is taken in the first, laid together in the second (core/arena.h).
inline constexpr int kWarmUpFrames = 3;

struct FrameSize {
  int width, height, disparities;

  double pixels() const { return 1.0 * width * height; }
  std::string name() const;  ///< "1280x720/D64"
};

struct ImagePair {
  cv::Mat left, right;  ///< CV_8UC3
};

class BenchmarkInputs {
 public:
  /// `folder`: a scene in Middlebury's layout. Where there is none, a rendered scene stands in; description()
  /// says so.
  explicit BenchmarkInputs(const std::string& folder);

  /// The pair, resized so that it fills the width, or so that its largest disparity is the last but one of
  /// `size`, whichever makes it smaller; repeated side by side and downwards where that leaves the frame
  /// unfilled. Nothing is mirrored, so disparities stay true; they scale with the image.
  ImagePair at(const FrameSize& size) const;

  const std::string& description() const { return description_; }

 private:
  ImagePair original_;
  double largest_disparity_px_;
  std::string description_;
};

}  // namespace pomona
