// Dense disparity from a stereo pair.
#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "pomona/disparity.h"
#include "pomona/options.h"
#include "pomona/rig.h"

namespace pomona {

/// Matches frame after frame, reusing every buffer. One engine serves one thread at a time.
class StereoEngine {
 public:
  /// Throws std::invalid_argument if `options` is not valid.
  explicit StereoEngine(const Options& options = {});
  /// For a camera whose views are not rectified: compute() takes them as they come and rectifies them, by
  /// maps that are made here. All maps of the result then belong to the rectified left view, leftView().
  /// Pixels that the left camera does not see count as masked. For a rig that is rectified as it comes,
  /// nothing is done to the views, but their size must be the rig's, where it is known. Throws
  /// std::invalid_argument if `options` is not valid or the rig cannot be rectified: cameras one above the
  /// other, one behind the other or exchanged, an unknown image size.
  StereoEngine(const Options& options, const StereoRig& rig);
  ~StereoEngine();
  StereoEngine(StereoEngine&&) noexcept;
  StereoEngine& operator=(StereoEngine&&) noexcept;

  /// `left`, `right`: views, rectified unless the engine has a rig for that, of equal size and type, CV_8U or
  /// CV_16U with 1 or 3 channels (BGR), any stride; of 16-bit values, those stages that work on 8 bits use
  /// the upper ones of the bits that all but a thousandth of the values fit in. `mask`: empty, or CV_8U of
  /// the same size; pixels that are 0 are neither measured nor filled. The result shares its maps with the
  /// engine: they stay valid until the next call, and their rows may be apart; clone() what must last. Throws
  /// std::invalid_argument for unusable input.
  const StereoResult& compute(const cv::Mat& left, const cv::Mat& right, const cv::Mat& mask = {});

  const Options& options() const;

  /// What turns the disparities into depth: the rig's rectified form. Throws std::logic_error if the engine
  /// was made without a rig.
  const StereoCalibration& calibration() const;
  /// The views that the last result belongs to: rectified by the engine, or as they were given. They are
  /// shared like the result's maps. Empty before the first call.
  const cv::Mat& leftView() const;
  const cv::Mat& rightView() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// One pair, one call. The result owns its maps.
StereoResult computeDisparity(const cv::Mat& left, const cv::Mat& right, const Options& options = {},
                              const cv::Mat& mask = {});

/// The number of disparities (from options.min_disparity up, a multiple of 16) that the pair seems to need
/// where `mask` does not exclude it, from a match at a quarter of its size. Never more than the image width
/// or 1024. Of the options, min_disparity, threads and isa count.
int estimateNumDisparities(const cv::Mat& left, const cv::Mat& right, const Options& options = {},
                           const cv::Mat& mask = {});

}  // namespace pomona
