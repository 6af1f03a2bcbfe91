#include <opencv2/core.hpp>
#include <span>
#include <stdexcept>

#include "datasets/atomic_file.h"
#include "datasets/input_file.h"
#include "datasets/middlebury_calib.h"
#include "pomona/rig.h"

namespace pomona {
namespace {

std::string listOf(std::span<const double> values) {
  std::string list;
  for (const double value : values) list += (list.empty() ? "" : ", ") + numberText(value);
  return list;
}

cv::Matx34d projectionOf(const StereoCalibration& c, bool right) {
  const double f = c.focal_px, cx = c.cx_px + (right ? c.doffs_px : 0), t = right ? -f * c.baseline_m : 0;
  return {f, 0, cx, t, 0, f, c.cy_px, 0, 0, 0, 1, 0};
}

std::size_t coefficientCount(const CameraModel& camera) {
  if (camera.distortion_model == DistortionModel::kFisheye) return 4;
  const bool rational = camera.distortion[5] != 0 || camera.distortion[6] != 0 || camera.distortion[7] != 0;
  return rational ? 8 : 5;
}

std::string encodeOpenCv(const StereoRig& rig) {
  cv::FileStorage file(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  const auto coefficients = [](const CameraModel& c) {
    return cv::Mat(1, static_cast<int>(coefficientCount(c)), CV_64F,
                   const_cast<double*>(c.distortion.data()));
  };
  file << "length_unit"
       << "m";
  if (rig.left.width > 0) file << "image_width" << rig.left.width << "image_height" << rig.left.height;
  file << "distortion_model"
       << (rig.left.distortion_model == DistortionModel::kFisheye ? "fisheye" : "polynomial");
  file << "M1" << cv::Mat(rig.left.matrix()) << "D1" << coefficients(rig.left);
  file << "M2" << cv::Mat(rig.right.matrix()) << "D2" << coefficients(rig.right);
  file << "R" << cv::Mat(rig.right_from_left_rotation) << "T" << cv::Mat(rig.right_from_left_m);
  if (rig.rectification) {
    const StereoCalibration& c = rig.rectification->calibration;
    file << "R1" << cv::Mat(rig.rectification->left_rotation);
    file << "R2" << cv::Mat(rig.rectification->right_rotation);
    file << "P1" << cv::Mat(projectionOf(c, false)) << "P2" << cv::Mat(projectionOf(c, true));
    if (c.width > 0) file << "rectified_width" << c.width << "rectified_height" << c.height;
    if (c.num_disparities > 0) file << "num_disparities" << c.num_disparities;
  }
  return file.releaseAndGetString();
}

std::string encodeCameraInfo(const char* name, const CameraModel& camera, const cv::Matx33d& rotation,
                             const cv::Matx34d& projection) {
  const std::span<const double> coefficients(camera.distortion.data(), coefficientCount(camera));
  const char* model = camera.distortion_model == DistortionModel::kFisheye ? "equidistant"
                      : coefficients.size() == 8                           ? "rational_polynomial"
                                                                           : "plumb_bob";
  const auto matrix = [](const char* key, int rows, std::span<const double> values) {
    return std::string(key) + ":\n  rows: " + std::to_string(rows) +
           "\n  cols: " + std::to_string(values.size() / static_cast<std::size_t>(rows)) + "\n  data: [" +
           listOf(values) + "]\n";
  };
  return "image_width: " + std::to_string(camera.width) + "\nimage_height: " + std::to_string(camera.height) +
         "\ncamera_name: " + name + "\n" + matrix("camera_matrix", 3, camera.matrix().val) +
         "distortion_model: " + model + "\n" + matrix("distortion_coefficients", 1, coefficients) +
         matrix("rectification_matrix", 3, rotation.val) + matrix("projection_matrix", 3, projection.val);
}

void writeRos(const std::string& folder, const StereoRig& rig) {
  const Rectification rectification = rectificationOf(rig);
  const StereoCalibration& c = rectification.calibration;
  if (rig.left.width == 0)
    throw std::invalid_argument("the images' size is unknown; camera_info must state it");
  if (c.width != rig.left.width || c.height != rig.left.height)
    throw std::invalid_argument("size of the rectified views is " + std::to_string(c.width) + "x" +
                                std::to_string(c.height) + "; allowed in camera_info: the cameras', " +
                                std::to_string(rig.left.width) + "x" + std::to_string(rig.left.height));
  const OutputFile files[] = {
      {"left.yaml", encodeCameraInfo("left", rig.left, rectification.left_rotation, projectionOf(c, false))},
      {"right.yaml",
       encodeCameraInfo("right", rig.right, rectification.right_rotation, projectionOf(c, true))},
  };
  writeFolder(folder, files);
}

}  // namespace

std::string encodeRig(const StereoRig& rig) {
  rig.validate();
  return encodeOpenCv(rig);
}

void writeRig(const std::string& path, const StereoRig& rig, RigFormat format) {
  rig.validate();
  switch (format) {
    case RigFormat::kPomona:
      return writeFile(path, encodeOpenCv(rig));
    case RigFormat::kRos:
      return writeRos(path, rig);
    case RigFormat::kMiddlebury:
      return writeFile(path, encodeMiddleburyCalibration(rectificationOf(rig).calibration));
  }
}

}  // namespace pomona
