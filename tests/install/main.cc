// What an outside program does with the installed library: match a pair, and believe the result.
#include <pomona/calibration.h>
#include <pomona/engine.h>

#include <cmath>
#include <cstdio>

namespace {

constexpr int kWidth = 160, kHeight = 96, kShift_px = 9;

// A texture with a random gray value per pixel, seen by two cameras as a wall: every disparity is kShift_px.
cv::Mat wallSeenFrom(int offset_px) {
  cv::Mat texture(kHeight, kWidth + kShift_px, CV_8U);
  cv::RNG(42).fill(texture, cv::RNG::UNIFORM, 0, 256);
  return texture.colRange(offset_px, offset_px + kWidth);
}

int check(const pomona::StereoResult& result, int first_column) {
  int wrong = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = first_column; x < kWidth; ++x)
      if (!(std::abs(result.disparity.at<float>(y, x) - kShift_px) <= 0.5f)) ++wrong;
  std::printf("%d of %d pixels wrong\n", wrong, kHeight * (kWidth - first_column));
  return wrong == 0 ? 0 : 1;
}

}  // namespace

int main() {
  pomona::Options options;
  options.num_disparities = 32;
  const pomona::StereoResult result = computeDisparity(wallSeenFrom(0), wallSeenFrom(kShift_px), options);

  pomona::StereoCalibration calibration;
  calibration.focal_px = 450;
  calibration.baseline_m = 0.1;
  const cv::Mat depth = pomona::depthFromDisparity(result.disparity, calibration);
  if (!(std::abs(depth.at<float>(kHeight / 2, kWidth / 2) - 5.0f) < 0.3f)) {
    std::printf("depth %f m; 5 m was expected\n", depth.at<float>(kHeight / 2, kWidth / 2));
    return 1;
  }
  return check(result, kShift_px);
}
