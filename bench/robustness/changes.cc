#include "bench/robustness/changes.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

namespace pomona {
namespace {

template <typename Curve>
cv::Mat throughCurve(const cv::Mat& view, Curve curve) {
  cv::Mat table(1, 256, CV_8U), changed;
  for (int i = 0; i < 256; ++i) table.at<std::uint8_t>(i) = cv::saturate_cast<std::uint8_t>(curve(i));
  cv::LUT(view, table, changed);
  return changed;
}

/// Independent in every pixel and channel, with the given standard deviation.
cv::Mat withNoise(const cv::Mat& view, double sigma) {
  constexpr std::uint64_t kSeed = 20;
  cv::Mat grain(view.size(), CV_MAKETYPE(CV_32F, view.channels())), light, changed;
  cv::RNG(kSeed).fill(grain, cv::RNG::NORMAL, 0, sigma);
  view.convertTo(light, CV_32F);
  cv::Mat(light + grain).convertTo(changed, CV_8U);
  return changed;
}

/// The picture moves down by `rows`.
cv::Mat shifted(const cv::Mat& view, double rows) {
  const cv::Mat transform = (cv::Mat_<double>(2, 3) << 1, 0, 0, 0, 1, rows);
  cv::Mat changed;
  cv::warpAffine(view, changed, transform, view.size(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return changed;
}

cv::Mat blurred(const cv::Mat& view, double sigma_px) {
  cv::Mat changed;
  cv::GaussianBlur(view, changed, {}, sigma_px);
  return changed;
}

cv::Mat compressed(const cv::Mat& view, int quality) {
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".jpg", view, bytes, {cv::IMWRITE_JPEG_QUALITY, quality}))
    throw std::runtime_error("the view cannot be written as JPEG");
  return cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
}

constexpr Change kChanges[] = {
    {"unchanged", [](const cv::Mat& view) { return view; }},
    {"gain x0.7", [](const cv::Mat& view) { return throughCurve(view, [](int i) { return 0.7 * i; }); }},
    {"offset +20", [](const cv::Mat& view) { return throughCurve(view, [](int i) { return i + 20; }); }},
    {"gain x0.7, offset +20",
     [](const cv::Mat& view) { return throughCurve(view, [](int i) { return 0.7 * i + 20; }); }},
    {"gamma 1.3",
     [](const cv::Mat& view) {
       return throughCurve(view, [](int i) { return 255 * std::pow(i / 255.0, 1.3); });
     }},
    {"noise, sigma 5", [](const cv::Mat& view) { return withNoise(view, 5); }},
    {"noise, sigma 10", [](const cv::Mat& view) { return withNoise(view, 10); }},
    {"blur, sigma 1 px", [](const cv::Mat& view) { return blurred(view, 1); }},
    {"half a row lower", [](const cv::Mat& view) { return shifted(view, 0.5); }},
    {"one row lower", [](const cv::Mat& view) { return shifted(view, 1); }},
    {"JPEG, quality 60", [](const cv::Mat& view) { return compressed(view, 60); }},
};

}  // namespace

std::span<const Change> changes() {
  return kChanges;
}

}  // namespace pomona
