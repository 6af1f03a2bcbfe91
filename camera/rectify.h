// Turning the views of a stereo camera so that a point lies in the same row of both.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "core/image.h"
#include "pomona/rig.h"

namespace pomona {

/// Throws std::invalid_argument, calling the view `name`, unless it is CV_8U or CV_16U with 1 or 3 channels,
/// and of the rig's `size`.
void requireView(const char* name, const cv::Mat& view, cv::Size size);

/// Where each rectified pixel comes from, worked out once; every frame is then one look-up and a bilinear
/// mean per pixel, in whole numbers (weights of 1/256 px): the same bytes for any number of threads.
/// Allocates only when frames change their type.
class Rectifier {
 public:
  /// Throws std::invalid_argument if the rig cannot be rectified (see StereoRig::validate()) or its image
  /// size is not known.
  explicit Rectifier(const StereoRig& rig);

  /// Of the rectified views.
  const StereoCalibration& calibration() const { return calibration_; }

  /// Rectifies a pair as the cameras took it: CV_8U or CV_16U, 1 or 3 channels, both alike and of the rig's
  /// size, or std::invalid_argument is thrown. Pixels that a camera does not see are 0.
  void rectify(const cv::Mat& left, const cv::Mat& right, int threads);
  const cv::Mat& left() const { return views_[0]; }
  const cv::Mat& right() const { return views_[1]; }

  /// A mask of the left camera's view (CV_8U, or empty: all of it), rectified: 0 where it is 0 at the nearest
  /// pixel, or where the camera sees nothing. Empty if nothing is masked.
  const cv::Mat& rectifyMask(const cv::Mat& mask, int threads);

 private:
  struct Source {
    std::int16_t x, y;     // the upper left one of four pixels
    std::uint16_t fx, fy;  // 1/256 px further right and down, 0 to 256
  };
  struct Map {
    Image<Source> sources;     // anything where the camera sees nothing
    Image<std::uint8_t> seen;  // 255, or 0 there
    bool all_seen = true;
  };
  static void fill(Map& map, const CameraModel& camera, const cv::Matx33d& rotation, double cx_px,
                   const StereoCalibration& calibration);
  template <typename T, int kChannels>
  static void applyRow(const Source* source, int width, const cv::Mat& view, T* out);
  template <typename T, int kChannels>
  static void apply(const Map& map, const cv::Mat& view, cv::Mat& rectified, int threads);

  StereoCalibration calibration_;
  cv::Size input_size_;
  Map maps_[2];
  cv::Mat views_[2];
  cv::Mat mask_, no_mask_;
};

}  // namespace pomona
