#include "bench/depth/depth_bins.h"

#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>
#include <stdexcept>

#include "bench/accuracy/table.h"

namespace pomona {
namespace {

std::string fixed(double value, int decimals) {
  if (std::isnan(value)) return "-";
  std::ostringstream out;
  out << std::fixed << std::setprecision(decimals) << value;
  return out.str();
}

std::string nameOf(const DepthBin& bin) {
  std::ostringstream out;
  out << bin.nearest_m << " - " << bin.farthest_m << " m";
  return out.str();
}

}  // namespace

std::vector<DepthBin> depthBins(const StereoResult& map, const cv::Mat& truth_px,
                                const StereoCalibration& calibration, double bin_m) {
  if (!(bin_m > 0)) throw std::invalid_argument("the depth of a bin must be above 0 m");
  if (truth_px.size() != map.disparity.size())
    throw std::invalid_argument("the truth must have the disparity map's size");
  const cv::Mat true_m = depthFromDisparity(truth_px, calibration);
  const cv::Mat measured_m = depthFromDisparity(map.disparity, calibration);
  const cv::Mat sigma_m =
      map.sigma_px.empty() ? cv::Mat() : depthSigma(map.disparity, map.sigma_px, calibration);
  std::map<int, DepthBin> bins;
  for (int y = 0; y < true_m.rows; ++y)
    for (int x = 0; x < true_m.cols; ++x) {
      const double z_m = true_m.at<float>(y, x);
      if (!std::isfinite(z_m) || z_m == 0) continue;  // an infinite disparity has no depth
      const int number = static_cast<int>(z_m / bin_m);
      DepthBin& bin = bins[number];
      bin.nearest_m = number * bin_m;
      bin.farthest_m = (number + 1) * bin_m;
      bin.pixels.push_back(
          {z_m, measured_m.at<float>(y, x), sigma_m.empty() ? kNoDistance : sigma_m.at<float>(y, x)});
    }
  std::vector<DepthBin> sorted;
  for (auto& [number, bin] : bins) sorted.push_back(std::move(bin));
  return sorted;
}

std::string depthTable(const std::vector<DepthErrors>& methods, const StereoCalibration& calibration) {
  std::ostringstream out;
  std::vector<std::string> header = {"depth", "pixels", "1 px is"};
  for (const DepthErrors& method : methods) {
    for (const char* column : {"median", "median", "P95", "within 2 sigma"}) header.emplace_back(column);
    header[header.size() - 4] = method.method + ": median";
  }
  addHeader(out, header);
  for (std::size_t i = 0; i < methods.front().bins.size(); ++i) {
    const DepthBin& bin = methods.front().bins[i];
    const double middle_m = (bin.nearest_m + bin.farthest_m) / 2;
    std::vector<std::string> cells = {
        nameOf(bin), std::to_string(bin.pixels.size()),
        fixed(100 * middle_m / (calibration.focal_px * calibration.baseline_m), 2) + " %"};
    for (const DepthErrors& method : methods) {
      const DistanceErrors e = errorsOf(method.bins[i].pixels);
      cells.push_back(fixed(e.median_mm, 1) + " mm");
      cells.push_back(fixed(e.median_percent, 2) + " %");
      cells.push_back(fixed(e.p95_percent, 2) + " %");
      const std::string share = fixed(e.within_2_sigma_percent, 0);
      cells.push_back(share == "-" ? share : share + " %");
    }
    addRow(out, cells);
  }
  return out.str();
}

}  // namespace pomona
