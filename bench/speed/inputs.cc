#include "bench/speed/inputs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "datasets/disparity_file.h"
#include "datasets/image_file.h"
#include "datasets/named_scenes.h"

namespace pomona {
namespace {

double largestOf(const cv::Mat& disparity) {
  double largest = 0;
  cv::minMaxLoc(disparity, nullptr, &largest, nullptr, nullptr, disparity == disparity);  // NaN is unequal
  return largest;
}

cv::Mat tiled(const cv::Mat& image, double scale, const FrameSize& size) {
  cv::Mat resized, frame;
  cv::resize(image, resized, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
  const auto copies = [](int whole, int part) { return (whole + part - 1) / part; };
  cv::repeat(resized, copies(size.height, resized.rows), copies(size.width, resized.cols), frame);
  return frame(cv::Rect(0, 0, size.width, size.height)).clone();
}

}  // namespace

std::string FrameSize::name() const {
  return std::to_string(width) + "x" + std::to_string(height) + "/D" + std::to_string(disparities);
}

BenchmarkInputs::BenchmarkInputs(const std::string& folder) {
  const std::filesystem::path scene(folder);
  if (std::filesystem::exists(scene / "disp0GT.pfm")) {
    original_ = {readImage(scene / "im0.png"), readImage(scene / "im1.png")};
    largest_disparity_px_ = largestOf(readDisparity(scene / "disp0GT.pfm"));
    description_ = "the real pair " + scene.filename().string();
  } else {
    constexpr int kWidth = 741, kHeight = 500, kDisparities = 64;
    const RenderedPair pair = render(namedScene("trees", 1, kWidth, kHeight, kDisparities));
    original_ = {pair.left.image, pair.right.image};
    largest_disparity_px_ = largestOf(pair.left.disparity);
    description_ = "RENDERED trees, as " + folder + " holds no scene (scripts/get_samples motorcycle)";
  }
}

ImagePair BenchmarkInputs::at(const FrameSize& size) const {
  const double scale =
      std::min(1.0 * size.width / original_.left.cols, (size.disparities - 1) / largest_disparity_px_);
  return {tiled(original_.left, scale, size), tiled(original_.right, scale, size)};
}

}  // namespace pomona
