// KITTI's calibration files: those of the stereo benchmarks and the odometry (P0: to P3:), and of the raw
// recordings and the 2015 benchmark (calib_cam_to_cam.txt).
#include <cmath>
#include <stdexcept>

#include "datasets/rig_formats.h"

namespace pomona {
namespace {

constexpr double kLongestSide = 32'000;

std::string keyOf(std::string name, int camera) {
  return name.append(camera < 10 ? "_0" : "_").append(std::to_string(camera));
}

template <int Rows, int Cols>
cv::Matx<double, Rows, Cols> matrix(const KeyedFile& file, const std::string& key) {
  file.require(key);
  cv::Matx<double, Rows, Cols> m;
  file.numbers(key, m.val, std::to_string(Rows * Cols) + " finite numbers");
  return m;
}

RectifiedView view(const KeyedFile& file, const std::string& key) {
  cv::Matx34d p = matrix<3, 4>(file, key);
  // All of KITTI's cameras share a frame; what they are off its rows is at most some millimetres.
  try {
    return rectifiedView(p);
  } catch (const std::invalid_argument& e) {
    file.fail(key, e.what());
  }
}

cv::Size size(const KeyedFile& file, const std::string& key) {
  if (!file.has(key)) return {};
  const cv::Matx12d s = matrix<1, 2>(file, key);
  for (const double side : s.val)
    if (!(side >= 1 && side <= kLongestSide && side == std::floor(side)))
      file.fail(key, "width and height, whole numbers from 1 to 32000");
  return {static_cast<int>(s(0)), static_cast<int>(s(1))};
}

CameraModel rawCamera(const KeyedFile& file, int number) {
  CameraModel camera;
  const cv::Matx33d k = matrix<3, 3>(file, keyOf("K", number));
  if (!(k(0, 0) > 0 && k(1, 1) > 0)) file.fail(keyOf("K", number), "fx 0 cx 0 fy cy 0 0 1 with fx, fy > 0");
  camera.fx_px = k(0, 0);
  camera.fy_px = k(1, 1);
  camera.cx_px = k(0, 2);
  camera.cy_px = k(1, 2);
  const cv::Matx<double, 1, 5> d = matrix<1, 5>(file, keyOf("D", number));
  for (int i = 0; i < 5; ++i) camera.distortion[i] = d(i);
  const cv::Size raw_size = size(file, keyOf("S", number));
  camera.width = raw_size.width;
  camera.height = raw_size.height;
  return camera;
}

StereoRig rawRig(const KeyedFile& file, int left, int right, double unit_m) {
  StereoRig rig;
  rig.left = rawCamera(file, left);
  rig.right = rawCamera(file, right);
  // R_ and T_ lead from camera 0 to each.
  const cv::Matx33d left_rotation = matrix<3, 3>(file, keyOf("R", left));
  const cv::Matx31d left_m = matrix<3, 1>(file, keyOf("T", left)) * unit_m;
  const cv::Matx31d right_m = matrix<3, 1>(file, keyOf("T", right)) * unit_m;
  rig.right_from_left_rotation = matrix<3, 3>(file, keyOf("R", right)) * left_rotation.t();
  const cv::Matx31d translation = right_m - rig.right_from_left_rotation * left_m;
  rig.right_from_left_m = {translation(0), translation(1), translation(2)};
  rig.rectification =
      Rectification{matrix<3, 3>(file, keyOf("R_rect", left)), matrix<3, 3>(file, keyOf("R_rect", right)),
                    calibrationOf(view(file, keyOf("P_rect", left)), view(file, keyOf("P_rect", right)),
                                  unit_m, size(file, keyOf("S_rect", left)))};
  return rig;
}

}  // namespace

StereoRig rigFromKitti(const KeyedFile& file, const RigFileOptions& options, double unit_m) {
  const int left = options.left_camera < 0 ? 2 : options.left_camera;
  const int right = options.right_camera < 0 ? 3 : options.right_camera;
  if (file.has(keyOf("K", left))) return rawRig(file, left, right, unit_m);
  if (file.has(keyOf("P_rect", left)))
    return rigOf(calibrationOf(view(file, keyOf("P_rect", left)), view(file, keyOf("P_rect", right)), unit_m,
                               size(file, keyOf("S_rect", left))));
  const RectifiedView left_view = view(file, std::string("P").append(std::to_string(left)));
  return rigOf(
      calibrationOf(left_view, view(file, std::string("P").append(std::to_string(right))), unit_m, {}));
}

}  // namespace pomona
