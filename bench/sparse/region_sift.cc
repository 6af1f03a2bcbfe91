// region-sift: how many verified features, how many of them right, and how long it takes, beside plain SIFT
// and the dense map.
#include <iomanip>
#include <opencv2/features2d.hpp>

#include "bench/sparse/comparison.h"
#include "bench/sparse/pairs.h"
#include "bench/sparse/tables.h"
#include "datasets/atomic_file.h"
#include "datasets/image_file.h"
#include "plugins/common/matching.h"
#include "plugins/common/sift.h"
#include "plugins/common/stopwatch.h"
#include "pomona/plugin_host.h"

namespace pomona {
namespace {

// The distance alone, on the features of one pair, repeated until there are 5000 in each view.
void writeDistanceTimes(std::ostream& out, const TruthPair& pair, int repetitions) {
  constexpr int kFeatures = 5000;
  SiftOptions many;
  many.contrast_threshold = 0.005;
  const auto repeated = [&](const cv::Mat& view) {
    const cv::Mat descriptors = siftFeatures(view, {}, many).descriptors;
    cv::Mat all;
    while (all.rows < kFeatures) all.push_back(descriptors);
    return cv::Mat(all.rowRange(0, kFeatures));
  };
  const cv::Mat left = repeated(pair.left), right = repeated(pair.right);
  cv::Mat left_floats, right_floats;
  left.convertTo(left_floats, CV_32F);
  right.convertTo(right_floats, CV_32F);
  MatchOptions combined;
  combined.distance = DescriptorDistance::kCombined;
  combined.mutual = false;
  combined.threads = cv::getNumThreads();
  std::vector<double> combined_ms, euclid_ms;
  std::vector<std::vector<cv::DMatch>> nearest;
  for (int i = 0; i < repetitions; ++i) {
    Stopwatch watch;
    matchKeypoints(left, right, combined);
    combined_ms.push_back(watch.lapMs());
    cv::BFMatcher(cv::NORM_L2).knnMatch(left_floats, right_floats, nearest, 2);
    euclid_ms.push_back(watch.lapMs());
  }
  out << "\nTwo nearest of " << kFeatures << " x " << kFeatures
      << " descriptors of 128 values, all against all: " << std::setprecision(1) << medianOf(combined_ms)
      << " ms by the combined distance on bytes, " << medianOf(euclid_ms)
      << " ms by cv::BFMatcher's Euclid on floats (" << cv::getNumThreads() << " threads).\n\n";
}

void drawMap(const TruthPair& pair, const std::string& folder) {
  PluginHost host;
  LoadedPlugin& plugin = host.plugin("region-sift");
  const SparseResult result = plugin.run(pair.left, pair.right, pair.calibration, plugin.settings());
  writeFile(folder + "/region-sift-left.png", encodeImage(pair.left));
  for (const SparsePicture& picture : result.pictures)
    writeFile(folder + "/region-sift-" + picture.name + ".png", encodeImage(picture.image));
}

}  // namespace

void writeRegionSiftTable(std::ostream& out, const SparseTableOptions& options) {
  const std::vector<TruthPair> rooms = indoorPairs(), real = realPairs(options.scenes);
  out << "## region-sift\n\nRendered rooms with low-contrast floors:\n\n";
  writePointComparison(out, "region-sift", rooms, options.repetitions);
  if (!real.empty()) {
    out << "\nReal pairs:\n\n";
    writePointComparison(out, "region-sift", real, options.repetitions);
  }
  writeDistanceTimes(out, rooms.back(), options.repetitions);
  if (!options.pictures.empty()) drawMap(rooms.back(), options.pictures);
}

}  // namespace pomona
