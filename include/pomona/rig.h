// A stereo camera as it is mounted: two lenses, and where the right camera stands. Read from the files of
// those who calibrated it, whatever their format.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "pomona/calibration.h"

namespace pomona {

enum class DistortionModel {
  kPolynomial,  ///< Brown-Conrady with OpenCV's rational extension; ROS plumb_bob and rational_polynomial
  kFisheye,     ///< equidistant, Kannala & Brandt 2006; OpenCV's cv::fisheye
};

/// One camera and its lens. Pixel centres have whole coordinates.
struct CameraModel {
  int width = 0, height = 0;  ///< of the images the figures belong to; both 0 if unknown
  double fx_px = 0, fy_px = 0;
  double cx_px = 0, cy_px = 0;
  DistortionModel distortion_model = DistortionModel::kPolynomial;
  /// kPolynomial: k1 k2 p1 p2 k3 k4 k5 k6, as OpenCV counts them; kFisheye: k1 k2 k3 k4.
  std::array<double, 8> distortion{};

  cv::Matx33d matrix() const { return {fx_px, 0, cx_px, 0, fy_px, cy_px, 0, 0, 1}; }
  bool isDistorted() const;
  /// The pixel that sees the direction (x, y, 1) of the camera's frame.
  cv::Vec2d pixelOf(const cv::Vec2d& direction) const;
  /// The inverse: (x, y) of the direction (x, y, 1) that `pixel` sees, to 1e-9; NaN where the model has none.
  cv::Vec2d directionOf(const cv::Vec2d& pixel) const;
};

/// How two views are turned so that a point lies in the same row of both.
struct Rectification {
  cv::Matx33d left_rotation = cv::Matx33d::eye();   ///< rectified frame from the left camera's
  cv::Matx33d right_rotation = cv::Matx33d::eye();  ///< rectified frame from the right camera's
  StereoCalibration calibration;                    ///< of the rectified views, their size included
};

struct StereoRig {
  CameraModel left, right;
  /// A point X of the left camera's frame (X right, Y down, Z forward) is R X + T in the right camera's. The
  /// right camera stands to the right, so T.x is negative.
  cv::Matx33d right_from_left_rotation = cv::Matx33d::eye();
  cv::Vec3d right_from_left_m;
  /// The rectification that the rig's file states; without one, rectificationOf() works one out.
  std::optional<Rectification> rectification;

  double baselineM() const { return cv::norm(right_from_left_m); }
  /// Whether the cameras' images are rectified as they come: no distortion, equal focal lengths, rows
  /// aligned.
  bool isRectified() const;
  /// Throws std::invalid_argument naming the field, its value and what is allowed: also for cameras one above
  /// the other, one behind the other, exchanged, or turned by more than 45 degrees against each other.
  void validate() const;
};

/// The rig whose views are rectified as they come, with `calibration`'s geometry.
StereoRig rigOf(const StereoCalibration& calibration);

/// The stated rectification, or for a rectified rig none (identity), or the one of Bouguet's method
/// (cv::stereoRectify) that shows no pixel from outside of the views and keeps their size. Throws
/// std::invalid_argument if the rig is not valid, or has neither a rectification nor an image size.
Rectification rectificationOf(const StereoRig& rig);

/// What a rig's file leaves open.
struct RigFileOptions {
  /// Length of the file's unit in metres (0.001: millimetres), for files whose unit isn't the one that their
  /// format prescribes; 0: as prescribed, metres where nothing is (OpenCV).
  double unit_m = 0;
  /// Which cameras of a file with more than two are the pair (Kalibr: cam0, cam1, ...; KITTI: 0 and 1 gray, 2
  /// and 3 colour); -1: Kalibr 0 and 1, KITTI 2 and 3.
  int left_camera = -1, right_camera = -1;
};

/// Reads a rig; the format is recognised by its contents:
/// - OpenCV's stereo samples and writeRig(): M1 D1 M2 D2 R T [R1 R2 P1 P2] [length_unit] in one file
/// - ROS camera_info: a folder with left.yaml and right.yaml; see also the other overload
/// - Kalibr camchain: cam0 and cam1
/// - Middlebury calib.txt: cam0=[...], baseline=...
/// - KITTI: P0 to P3 (rectified), or calib_cam_to_cam.txt (both)
///
/// Throws std::runtime_error "path: line N: field is 'value'; allowed: ..." for a file that cannot be
/// understood, contradicts itself, states a field twice or one side of the size only, or whose baseline is
/// outside 1 mm to 10 m (mostly a mistaken unit).
StereoRig readRig(const std::string& path, const RigFileOptions& options = {});

/// The same from two files: left and right camera_info (YAML as ROS writes it, in OpenCV's syntax, or as
/// `rostopic echo` prints it), or OpenCV's intrinsics.yml and extrinsics.yml.
StereoRig readRigPair(const std::string& left_path, const std::string& right_path,
                      const RigFileOptions& options = {});

enum class RigFormat {
  kPomona,      ///< OpenCV's cv::FileStorage YAML, in metres; everything that a StereoRig holds
  kRos,         ///< a folder with camera_info files left.yaml and right.yaml; with rectificationOf(rig)
  kMiddlebury,  ///< calib.txt of the rectified views: lenses and their places are lost
};

/// Writes a rig. Throws std::invalid_argument if it is not valid, std::runtime_error "path: reason" if that
/// fails; then nothing is left behind.
void writeRig(const std::string& path, const StereoRig& rig, RigFormat format = RigFormat::kPomona);

}  // namespace pomona
