// sobel-sift: how far off targets at 0.1 to 10 m are ranged, beside the published figures and the dense map.
#include <cmath>
#include <iomanip>

#include "bench/sparse/comparison.h"
#include "bench/sparse/pairs.h"
#include "bench/sparse/tables.h"
#include "bench/sparse/targets.h"
#include "plugins/common/stopwatch.h"
#include "pomona/engine.h"
#include "pomona/plugin_host.h"

namespace pomona {
namespace {

/// Relative errors of the targets of one bin.
struct Errors {
  int found = 0, targets = 0, points = 0;
  double target_sum = 0, point_sum = 0, ms = 0;  ///< sums of percent

  double targetPercent() const { return target_sum / found; }
  double pointPercent() const { return point_sum / points; }
};

double percentOff(double measured_m, double true_m) {
  return 100 * std::abs(measured_m - true_m) / true_m;
}

/// Where `mask` is not 0, row by row.
std::vector<double> depthsOf(const cv::Mat& depth_m, const cv::Mat& mask) {
  std::vector<double> depths;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (mask.at<std::uint8_t>(y, x)) depths.push_back(depth_m.at<float>(y, x));
  return depths;
}

void measureSparse(LoadedPlugin& plugin, const PluginSettings& settings, const TargetPair& pair,
                   Errors& errors) {
  PluginRunOptions inputs;
  inputs.mask = pair.mask;
  Stopwatch watch;
  const SparseResult result = plugin.run(pair.left, pair.right, pair.calibration, settings, inputs);
  errors.ms += watch.lapMs();
  ++errors.targets;
  for (const SparsePoint& p : result.points) {
    errors.point_sum += percentOff(p.point_m.z, truthAt(pair.depth_m, p.left_px));
    ++errors.points;
  }
  const SparseObject& target = result.objects.at(0);
  if (!target.found()) return;
  ++errors.found;
  errors.target_sum += percentOff(target.point_m.z, medianOf(depthsOf(pair.depth_m, pair.mask)));
}

// The median depth of the target's pixels.
void measureDense(const TargetPair& pair, Errors& errors) {
  Options options = Options::preset("balanced");
  options.num_disparities = pair.calibration.num_disparities;
  Stopwatch watch;
  const StereoResult result = computeDisparity(pair.left, pair.right, options);
  errors.ms += watch.lapMs();
  ++errors.targets;
  const cv::Mat depth = depthFromDisparity(result.disparity, pair.calibration);
  const cv::Mat known = pair.mask & (depth == depth);  // NaN is unequal
  const std::vector<double> z_m = depthsOf(depth, known), true_z_m = depthsOf(pair.depth_m, known);
  for (std::size_t i = 0; i < z_m.size(); ++i) errors.point_sum += percentOff(z_m[i], true_z_m[i]);
  errors.points += static_cast<int>(z_m.size());
  if (z_m.empty()) return;
  ++errors.found;
  errors.target_sum += percentOff(medianOf(z_m), medianOf(depthsOf(pair.depth_m, pair.mask)));
}

void writeErrors(std::ostream& out, const Errors& e) {
  out << e.found << "/" << e.targets << " | " << std::setprecision(3) << e.targetPercent() << " % | "
      << e.pointPercent() << " % | " << std::setprecision(0) << static_cast<double>(e.points) / e.targets
      << " | " << e.ms / e.targets << " | ";
}

}  // namespace

void writeSobelSiftTable(std::ostream& out, const SparseTableOptions& options) {
  constexpr int kTargetsPerBin = 12;
  PluginHost host;
  LoadedPlugin& plugin = host.plugin("sobel-sift");
  PluginSettings faithful = plugin.settings(), gray = plugin.settings();
  faithful.set("variant", "faithful");
  gray.set("edge_weight", "0");
  gray.set("contrast_threshold", "0.02");
  out << "## sobel-sift\n\nMean relative errors of the depths of targets, and of single points (pixels) on "
         "them:\n\n"
         "| distance, m | published | faithful: found | target | point | points | ms | default: found | "
         "target | "
         "point | points | ms | without edges: found | target | point | points | ms | dense: found | "
         "target | "
         "pixel | pixels | ms |\n|---|"
      << "--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
      << std::fixed;
  for (const DistanceBin& bin : distanceBins()) {
    Errors as_published, improved, without_edges, dense;
    for (const TargetPair& pair : targetPairs(bin, kTargetsPerBin)) {
      measureSparse(plugin, faithful, pair, as_published);
      measureSparse(plugin, plugin.settings(), pair, improved);
      measureSparse(plugin, gray, pair, without_edges);
      measureDense(pair, dense);
    }
    out << "| " << std::setprecision(1) << bin.nearest_m << " - " << bin.farthest_m << " | "
        << std::setprecision(2) << bin.published_percent << " % | ";
    for (const Errors* errors : {&as_published, &improved, &without_edges, &dense}) writeErrors(out, *errors);
    out << '\n';
  }
  out << '\n';
  if (const std::vector<TruthPair> real = realPairs(options.scenes); !real.empty()) {
    out << "Real pairs:\n\n";
    writePointComparison(out, "sobel-sift", real, options.repetitions);
    out << '\n';
  }
}

}  // namespace pomona
