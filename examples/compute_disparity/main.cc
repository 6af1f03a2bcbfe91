// compute_disparity LEFT RIGHT OUT.png: the shortest program that does it. 16 bits, 256 steps per pixel.
#include <pomona/engine.h>

#include <cstdio>
#include <exception>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>

int main(int argc, char** argv) try {
  if (argc != 4) return std::fputs("usage: compute_disparity LEFT RIGHT OUT.png\n", stderr), 2;
  const cv::Mat left = cv::imread(argv[1]), right = cv::imread(argv[2]);
  pomona::Options options = pomona::Options::preset("balanced");
  options.num_disparities = pomona::estimateNumDisparities(left, right);
  const pomona::StereoResult result = pomona::computeDisparity(left, right, options);
  cv::Mat steps;
  result.disparity.convertTo(steps, CV_16U, 256);
  if (!cv::imwrite(argv[3], steps)) throw std::runtime_error(std::string(argv[3]) + ": cannot be written");
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "compute_disparity: %s\n", e.what());
  return 1;
}
