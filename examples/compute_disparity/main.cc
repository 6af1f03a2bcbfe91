// compute_disparity LEFT RIGHT OUT.png: the shortest program that does it. 16 bits, 256 steps per pixel.
#include <pomona/engine.h>

#include <cstdio>
#include <exception>
#include <opencv2/imgcodecs.hpp>

int main(int argc, char** argv) try {
  if (argc != 4) return 2;
  const cv::Mat left = cv::imread(argv[1]), right = cv::imread(argv[2]);
  pomona::Options options = pomona::Options::preset("balanced");
  options.num_disparities = pomona::estimateNumDisparities(left, right);
  const pomona::StereoResult result = pomona::computeDisparity(left, right, options);
  cv::Mat steps;
  result.disparity.convertTo(steps, CV_16U, 256);
  return cv::imwrite(argv[3], steps) ? 0 : 1;
} catch (const std::exception& e) {
  std::fprintf(stderr, "compute_disparity: %s\n", e.what());
  return 1;
}
