// Every stereo method that can be compared, behind one interface and under one name each.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "pomona/options.h"

namespace pomona {

/// Checks in place of the method's own, as in ValidationOptions; what is empty stays as the method has it.
/// opencv-wls has none of them: its filter does without.
struct PostProcessing {
  std::optional<float> left_right_px;  ///< negative: off. OpenCV's take whole pixels from 1 up
  std::optional<int> speckle_size_px;  ///< 0: off
  std::optional<int> median_size;      ///< 0: off; 3 or 5. OpenCV's have none

  bool operator==(const PostProcessing&) const = default;
  ValidationOptions over(ValidationOptions usual) const;
};

struct MethodOptions {
  int min_disparity = 0;     ///< smallest disparity searched, pixels; may be negative
  int num_disparities = 64;  ///< number of disparities searched, 1..1024; at most the image width
  OutputMode mode = OutputMode::kDense;
  /// The winner of every pixel as it is, a whole disparity: nothing checked, removed, smoothed or filled.
  /// Overrides `mode`. (OpenCV's matchers always refine below the pixel.)
  bool raw = false;
  PostProcessing post_processing = {};  ///< OutputMode says whether holes are filled
  int threads = 0;  ///< worker threads; 0: one per available processor. OpenCV's methods choose their own.

  bool operator==(const MethodOptions&) const = default;
};

/// All maps have the size of the left image and are the caller's.
struct MethodResult {
  cv::Mat disparity;        ///< CV_32F, pixels, d = x_left - x_right; quiet NaN where unknown
  cv::Mat state;            ///< CV_8U, values of PixelState
  cv::Mat confidence;       ///< CV_32F, larger is surer, 0 where unknown; empty if the method has none
  double milliseconds = 0;  ///< wall-clock time from the two images to the finished maps
};

/// A stereo method. It may keep memory from pair to pair; one object serves one thread at a time.
class Method {
 public:
  virtual ~Method() = default;

  /// `left`, `right`: rectified views of equal size and type, CV_8U or CV_16U with 1 or 3 channels (BGR), any
  /// stride. The whole width is matched. Throws std::invalid_argument for unusable views or options.
  virtual MethodResult run(const cv::Mat& left, const cv::Mat& right, const MethodOptions& options) = 0;
};

struct MethodInfo {
  std::string_view name;         ///< as a user writes it, e.g. "opencv-sgbm"
  std::string_view description;  ///< one line
  std::unique_ptr<Method> (*make)();
};

/// All methods, sorted by name: Pomona's presets (fast, balanced, quality, paper), window methods (ssd, ncc,
/// asw), and OpenCV's matchers (opencv-...).
std::span<const MethodInfo> methods();

/// Pomona's presets alone, the fastest first, `paper` last.
std::span<const MethodInfo> presetMethods();

/// Throws std::invalid_argument for an unknown name; the message lists those that are known.
std::unique_ptr<Method> makeMethod(std::string_view name);

}  // namespace pomona
