#include "datasets/colorize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace pomona {
namespace {

using Color = cv::Vec3b;  // blue, green, red

const Color kBlack{0, 0, 0};
const Color kWhite{255, 255, 255};

const std::array<Color, 9> kColdToWarm = {Color{80, 20, 30},   Color{190, 60, 30},   Color{230, 140, 30},
                                          Color{190, 200, 50}, Color{110, 215, 100}, Color{50, 215, 190},
                                          Color{30, 150, 245}, Color{30, 70, 225},   Color{20, 10, 120}};
const std::array<Color, 5> kGoodToBad = {Color{40, 90, 20}, Color{60, 170, 60}, Color{60, 220, 230},
                                         Color{30, 130, 245}, Color{30, 20, 190}};

// `position` from 0 (first anchor) to 1 (last anchor), clamped; straight lines between anchors.
Color blend(std::span<const Color> anchors, float position) {
  const float scaled = std::clamp(position, 0.0f, 1.0f) * static_cast<float>(anchors.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(scaled), anchors.size() - 2);
  const float t = scaled - static_cast<float>(i);
  Color color;
  for (int c = 0; c < 3; ++c)
    color[c] = static_cast<std::uint8_t>(anchors[i][c] + t * (anchors[i + 1][c] - anchors[i][c]) + 0.5f);
  return color;
}

void requireType(const cv::Mat& map, int type, const char* name) {
  if (map.type() != type)
    throw std::invalid_argument(std::string(name) + " is " + cv::typeToString(map.type()) +
                                "; allowed: " + cv::typeToString(type));
}

}  // namespace

DisparityRange typicalRange(const cv::Mat& disparity) {
  requireType(disparity, CV_32FC1, "disparity");
  std::vector<float> known;
  known.reserve(disparity.total());
  for (int y = 0; y < disparity.rows; ++y)
    std::copy_if(disparity.ptr<float>(y), disparity.ptr<float>(y) + disparity.cols, std::back_inserter(known),
                 [](float d) { return std::isfinite(d); });
  if (known.empty()) return {0, 1};
  const auto quantile = [&](std::size_t percent) {
    const auto nth = known.begin() + static_cast<std::ptrdiff_t>((known.size() - 1) * percent / 100);
    std::nth_element(known.begin(), nth, known.end());
    return *nth;
  };
  const float low = quantile(1);
  return {low, std::max(quantile(99), low + 1)};
}

cv::Mat colorizeDisparity(const cv::Mat& disparity, DisparityRange range) {
  requireType(disparity, CV_32FC1, "disparity");
  cv::Mat image(disparity.size(), CV_8UC3);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const float d = disparity.at<float>(y, x);
      image.at<Color>(y, x) =
          std::isnan(d) ? kBlack : blend(kColdToWarm, (d - range.low) / (range.high - range.low));
    }
  return image;
}

cv::Vec3b stateColor(PixelState state) {
  switch (state) {
    case PixelState::kMeasured:
      return {215, 215, 215};
    case PixelState::kFilledBackground:
      return {60, 150, 40};
    case PixelState::kFilledInterpolated:
      return {120, 210, 140};
    case PixelState::kFilledCoarse:
      return {190, 170, 40};
    case PixelState::kFilledPlane:
      return {200, 225, 170};
    case PixelState::kOccluded:
      return {200, 80, 30};
    case PixelState::kMismatched:
      return {40, 40, 220};
    case PixelState::kAmbiguous:
      return {50, 220, 240};
    case PixelState::kSpeckle:
      return {200, 60, 190};
    case PixelState::kOutOfRange:
      return {30, 140, 250};
    case PixelState::kMasked:
      return kBlack;
  }
  return kWhite;
}

cv::Mat colorizeStates(const cv::Mat& states) {
  requireType(states, CV_8UC1, "states");
  cv::Mat image(states.size(), CV_8UC3);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      image.at<Color>(y, x) = stateColor(static_cast<PixelState>(states.at<std::uint8_t>(y, x)));
  return image;
}

cv::Mat confidenceToGray(const cv::Mat& confidence) {
  requireType(confidence, CV_32FC1, "confidence");
  cv::Mat image(confidence.size(), CV_8UC1);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const float c = confidence.at<float>(y, x);
      image.at<std::uint8_t>(y, x) = c > 0 ? static_cast<std::uint8_t>(std::min(c, 1.0f) * 255 + 0.5f) : 0;
    }
  return image;
}

cv::Mat colorizeError(const cv::Mat& disparity, const cv::Mat& ground_truth, float limit_px) {
  requireType(disparity, CV_32FC1, "disparity");
  requireType(ground_truth, CV_32FC1, "ground_truth");
  if (disparity.size() != ground_truth.size())
    throw std::invalid_argument("disparity and ground_truth differ in size");
  cv::Mat image(disparity.size(), CV_8UC3);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const float truth = ground_truth.at<float>(y, x), d = disparity.at<float>(y, x);
      image.at<Color>(y, x) = std::isnan(truth) ? kBlack
                              : std::isnan(d)   ? kWhite
                                                : blend(kGoodToBad, std::abs(d - truth) / limit_px);
    }
  return image;
}

}  // namespace pomona
