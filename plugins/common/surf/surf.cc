#include "plugins/common/surf/surf.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "core/parallel.h"
#include "plugins/common/surf/box_hessian.h"
#include "plugins/common/surf/descriptor.h"
#include "plugins/common/surf/interest_points.h"
#include "plugins/common/surf/orientation.h"

namespace pomona {
namespace {

constexpr float kRadians = std::numbers::pi_v<float> / 180;
constexpr float kLargestSize =
    480;  // of a keypoint, in px: its wavelets are no larger than haarResponse() allows
constexpr int kPointsPerTask = 16;

std::string sizeText(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

cv::Mat grayOf(const cv::Mat& image) {
  if (image.type() == CV_8UC1) return image;
  if (image.type() != CV_8UC3)
    throw std::invalid_argument("SURF: image is of type " + cv::typeToString(image.type()) +
                                "; allowed: CV_8UC1 or CV_8UC3");
  cv::Mat gray;
  cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
  return gray;
}

void checkMask(const cv::Mat& mask, const cv::Mat& image) {
  if (mask.empty()) return;
  if (mask.type() != CV_8UC1)
    throw std::invalid_argument("SURF: mask is of type " + cv::typeToString(mask.type()) +
                                "; allowed: CV_8UC1");
  if (mask.size() != image.size())
    throw std::invalid_argument("SURF: mask is " + sizeText(mask.size()) + " but image is " +
                                sizeText(image.size()) + "; both must have the same size");
}

void checkKeypoints(const std::vector<cv::KeyPoint>& keypoints, cv::Size size) {
  for (const auto& [point, diameter, angle, response, octave, class_id] : keypoints) {
    if (!(diameter > 0 && diameter <= kLargestSize))
      throw std::invalid_argument("SURF: keypoint size is " + std::to_string(diameter) +
                                  "; allowed: above 0, up to 480");
    const float right = static_cast<float>(size.width) - 0.5f,
                bottom = static_cast<float>(size.height) - 0.5f;
    if (!(point.x >= -0.5f && point.x <= right && point.y >= -0.5f && point.y <= bottom))
      throw std::invalid_argument("SURF: keypoint is at (" + std::to_string(point.x) + ", " +
                                  std::to_string(point.y) + "), outside the image of " + sizeText(size));
  }
}

std::vector<cv::KeyPoint> findKeypoints(const IntegralImage& image, const cv::Mat& mask,
                                        const SurfOptions& options) {
  std::vector<cv::KeyPoint> keypoints;
  for (const InterestPoint& p : findInterestPoints(image, options))
    if (mask.empty() || mask.at<std::uint8_t>(cvRound(p.y), cvRound(p.x)) != 0)
      keypoints.emplace_back(p.x, p.y, p.size_px, -1.0f, p.response, p.octave, p.is_dark ? 1 : -1);
  return keypoints;
}

/// Gives the point an angle if it needs one, and writes its descriptor, unless `out` is null.
void finish(const IntegralImage& image, const SurfOptions& options, cv::KeyPoint& point, float* out) {
  const float scale = scaleOfSize(point.size);
  if (!options.upright && point.angle < 0) {
    const float degrees = dominantOrientation(image, point.pt.x, point.pt.y, scale) / kRadians;
    point.angle = degrees < 0 ? std::fmod(degrees + 360, 360.0f) : degrees;
  }
  const float angle = options.upright ? 0 : point.angle * kRadians;
  if (out) describe(image, {point.pt.x, point.pt.y, scale, angle}, options.extended, out);
}

}  // namespace

std::string SurfOptions::problem() const {
  const auto wrong = [](const char* field, auto value, const char* allowed) {
    return std::string(field) + " is " + std::to_string(value) + "; allowed: " + allowed;
  };
  if (!(hessian_threshold > 0 && std::isfinite(hessian_threshold)))
    return wrong("hessian_threshold", hessian_threshold, "above 0");
  if (octaves < 1 || octaves > 5) return wrong("octaves", octaves, "1 to 5");
  if (layers < 3 || layers > 5) return wrong("layers", layers, "3 to 5");
  if (threads < 0) return wrong("threads", threads, "0 (all processors) or more");
  return {};
}

Surf::Surf(const SurfOptions& options) : options_(options) {
  if (const std::string problem = options.problem(); !problem.empty())
    throw std::invalid_argument("SURF: " + problem);
}

cv::Ptr<Surf> Surf::create(const SurfOptions& options) {
  return cv::makePtr<Surf>(options);
}

int Surf::descriptorSize() const {
  return descriptorLength(options_.extended);
}

void Surf::detectAndCompute(cv::InputArray image, cv::InputArray mask, std::vector<cv::KeyPoint>& keypoints,
                            cv::OutputArray descriptors, bool use_provided) {
  if (image.empty()) {
    keypoints.clear();
    if (descriptors.needed()) descriptors.create(0, descriptorSize(), CV_32F);
    return;
  }
  const cv::Mat gray = grayOf(image.getMat());
  checkMask(mask.getMat(), gray);
  if (use_provided) checkKeypoints(keypoints, gray.size());

  const IntegralImage integral({gray.ptr(), gray.cols, gray.rows, static_cast<std::ptrdiff_t>(gray.step1())});
  if (!use_provided) keypoints = findKeypoints(integral, mask.getMat(), options_);
  const int count = static_cast<int>(keypoints.size());
  cv::Mat rows;
  if (descriptors.needed()) {
    descriptors.create(count, descriptorSize(), CV_32F);
    rows = descriptors.getMat();
  }
  const int threads = options_.threads > 0 ? options_.threads : availableThreads();
  parallelFor(threads, (count + kPointsPerTask - 1) / kPointsPerTask, [&](int task) {
    for (int i = task * kPointsPerTask; i < std::min(count, (task + 1) * kPointsPerTask); ++i)
      finish(integral, options_, keypoints[i], rows.empty() ? nullptr : rows.ptr<float>(i));
  });
}

}  // namespace pomona
