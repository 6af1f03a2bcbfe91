// The readers behind readRig(), one per format, and the bytes behind writeRig(). Each takes a file's text
// (`path` is for messages) and throws std::runtime_error naming path, field, value and what is allowed. What
// concerns every format alike (a plausible baseline, a consistent rig) is checked by readRig().
#pragma once

#include <string>

#include "datasets/keyed_file.h"
#include "datasets/yaml_fields.h"
#include "pomona/rig.h"

namespace pomona {

/// M1 D1 M2 D2 R T, and R1 R2 P1 P2 if all are there. `extrinsics` may be `intrinsics`.
StereoRig rigFromOpenCv(const YamlFields& intrinsics, const YamlFields& extrinsics, double unit_m);

/// A pair of camera_info: the rig follows from the rectification, which such a file always states.
StereoRig rigFromRos(const YamlFields& left, const YamlFields& right, double unit_m);

/// The file that writeRig() writes for RigFormat::kPomona. Throws std::invalid_argument if `rig` is not
/// valid.
std::string encodeRig(const StereoRig& rig);

/// camN's T_cn_cnm1 leads from camera N - 1 to camera N.
StereoRig rigFromKalibr(const YamlFields& chain, const RigFileOptions& options, double unit_m);

/// P0 to P3, or calib_cam_to_cam.txt with K_, D_, R_, T_, R_rect_, P_rect_ per camera.
StereoRig rigFromKitti(const KeyedFile& file, const RigFileOptions& options, double unit_m);

/// OpenCV's order k1 k2 p1 p2 k3 k4 k5 k6 from a list of 0, 4, 5 or 8 (or more, which must be 0)
/// coefficients; 4 for the fisheye model.
void setDistortion(CameraModel& camera, const YamlFields& fields, const std::string& key);

/// f, cx, cy of a 3 x 4 projection matrix of a rectified view, and f * Tx in element (0, 3).
struct RectifiedView {
  double focal_px, cx_px, cy_px, offset;
};
/// Throws std::invalid_argument for a matrix that is none, saying what is allowed.
RectifiedView rectifiedView(const cv::Matx34d& projection);
RectifiedView rectifiedView(const YamlFields& fields, const std::string& key);

/// The rectified pair's geometry, `left` with its offset subtracted. Throws std::invalid_argument if the
/// views do not fit each other, or if the sign of the offset says that they are exchanged.
StereoCalibration calibrationOf(const RectifiedView& left, const RectifiedView& right, double unit_m,
                                cv::Size size);

}  // namespace pomona
