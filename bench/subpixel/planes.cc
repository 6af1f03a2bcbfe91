#include "bench/subpixel/planes.h"

#include <algorithm>
#include <cmath>

namespace pomona {
namespace {

constexpr int kWidth = 640, kHeight = 400;
constexpr double kFocal_px = 640, kBaseline_m = 0.12;

constexpr Texture kTextures[] = {
    {"fine", 6, 120}, {"middle", 12, 120}, {"coarse", 32, 120}, {"faint", 12, 25}};

/// d = middle + across (x - W / 2) + down (y - H / 2). The slopes share no period with the pixels.
struct Tilt {
  double middle, across, down;
};
constexpr Tilt kSlants[kTilts] = {{30.3, 0.0731, 0.0213}, {24.7, 0.0127, -0.0571}, {20.2, -0.0319, 0.0177}};

}  // namespace

std::span<const Texture> textures() {
  return kTextures;
}

RenderedPair slantedPlane(const Texture& texture, int tilt) {
  const Tilt& t = kSlants[tilt];
  const auto at = [&](double x_px, double y_px) {  // from the middle of the image
    const double z = kFocal_px * kBaseline_m / (t.middle + t.across * x_px + t.down * y_px);
    return cv::Vec3d(x_px, y_px, kFocal_px) * (z / kFocal_px);
  };
  SceneDescription scene;
  scene.width = kWidth;
  scene.height = kHeight;
  scene.focal_px = kFocal_px;
  scene.baseline_m = kBaseline_m;
  scene.num_disparities = kPlaneDisparities;
  scene.seed = static_cast<std::uint64_t>(tilt) + 1;
  const cv::Vec3d center = at(0, 0), middle = cv::Vec3d::all(128),
                  half = cv::Vec3d(1, 0.9, 0.8) * (texture.contrast / 2);
  scene.surfaces.push_back({Shape::kPlane,
                            center,
                            at(100, 0) - center,
                            at(0, 100) - center,
                            0,
                            {middle - half, middle + half, texture.cell_px * center[2] / kFocal_px}});
  return render(scene);
}

void addNoise(cv::Mat& view, double sigma, std::uint64_t seed) {
  cv::Mat grain(view.size(), CV_MAKETYPE(CV_32F, view.channels()));
  cv::RNG(seed).fill(grain, cv::RNG::NORMAL, 0, sigma);
  cv::add(view, grain, view, cv::noArray(), view.depth());
}

void FractionStatistics::add(const cv::Mat& disparity, const RenderedView& left) {
  for (int y = 0; y < disparity.rows; ++y)
    for (int x = 0; x < disparity.cols; ++x) {
      const float d = disparity.at<float>(y, x), truth = left.disparity.at<float>(y, x);
      if (left.mask.at<std::uint8_t>(y, x) != 255 || !(std::abs(d - truth) <= 1)) continue;
      ++counts_[std::min(kBins - 1, static_cast<int>((d - std::floor(d)) * kBins))];
      ++total_;
    }
  merge(subpixelErrors(disparity, left.disparity, left.mask, kBiasBins));
}

void FractionStatistics::add(const FractionStatistics& other) {
  for (int i = 0; i < kBins; ++i) counts_[i] += other.counts_[i];
  total_ += other.total_;
  merge(other.errors_);
}

void FractionStatistics::merge(const SubpixelErrors& errors) {
  const auto add = [](SubpixelErrors::Bin& into, const SubpixelErrors::Bin& bin) {
    into.count += bin.count;
    into.error_sum_px += bin.error_sum_px;
    into.squared_error_sum_px2 += bin.squared_error_sum_px2;
  };
  for (std::size_t i = 0; i < kBiasBins; ++i) add(errors_.bins[i], errors.bins[i]);
  add(errors_.all, errors.all);
}

double FractionStatistics::share(int bin) const {
  return static_cast<double>(counts_[bin]) * kBins / static_cast<double>(total_);
}

double FractionStatistics::unevenness() const {
  double sum = 0;
  for (int i = 0; i < kBins; ++i) sum += (share(i) - 1) * (share(i) - 1);
  return std::sqrt(sum / kBins);
}

double FractionStatistics::fullest() const {
  double most = 0;
  for (int i = 0; i < kBins; ++i) most = std::max(most, share(i));
  return most;
}

double FractionStatistics::swingPx() const {
  const auto [least, most] = std::minmax_element(
      errors_.bins.begin(), errors_.bins.end(),
      [](const SubpixelErrors::Bin& a, const SubpixelErrors::Bin& b) { return a.biasPx() < b.biasPx(); });
  return most->biasPx() - least->biasPx();
}

Options planeOptions(SubpixelMethod method, PlaneMap map) {
  Options options = Options::preset("balanced");
  options.num_disparities = kPlaneDisparities;
  options.winner.subpixel = method;
  options.mode = map == PlaneMap::kDense ? OutputMode::kDense : OutputMode::kSparse;
  if (map == PlaneMap::kRaw) {
    options.validation.left_right_px = -1;
    options.validation.speckle_size_px = 0;
    options.validation.median_size = 0;
  }
  return options;
}

}  // namespace pomona
