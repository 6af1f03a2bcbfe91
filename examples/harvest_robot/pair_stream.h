// Stereo frames from wherever they come.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

/// A source of pairs. Throws std::runtime_error if it cannot be opened.
class PairStream {
 public:
  virtual ~PairStream() = default;
  /// False at the end.
  virtual bool next(cv::Mat& left, cv::Mat& right) = 0;

  /// `source`: a folder with left*.png and right*.png (or .jpg), paired by what follows the side in their
  /// names; a video, or the number of a camera, whose frames hold both views side by side.
  static std::unique_ptr<PairStream> open(const std::string& source);
};
