// Stereo frames from wherever they come.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

struct Pair {
  cv::Mat left, right;
};

/// A source of pairs. Throws std::runtime_error if it cannot be opened, or read.
class PairStream {
 public:
  virtual ~PairStream() = default;
  /// None at the end. Pairs share nothing with those before them.
  virtual std::optional<Pair> next() = 0;

  /// `source`: a folder with left*.png and right*.png (or .jpg, .bmp), paired by what follows the side in
  /// their names; a video, or the number of a camera, whose frames hold both views side by side.
  static std::unique_ptr<PairStream> open(const std::string& source);
};
