// region-sift: how many verified features, how many of them right, and how long it takes, beside plain SIFT
// and the dense map.
#include <iomanip>
#include <opencv2/features2d.hpp>

#include "bench/sparse/pairs.h"
#include "bench/sparse/plain_sift.h"
#include "bench/sparse/tables.h"
#include "datasets/atomic_file.h"
#include "datasets/image_file.h"
#include "plugins/common/matching.h"
#include "plugins/common/sift.h"
#include "plugins/common/stopwatch.h"
#include "pomona/engine.h"
#include "pomona/plugin_host.h"

namespace pomona {
namespace {

/// One way of finding points in one pair.
struct Column {
  int features = 0, verified = 0;  ///< features of the left view
  PointAccuracy accuracy;
  double ms = 0;

  void add(const Column& other) {
    features += other.features;
    verified += other.verified;
    ms += other.ms;
    accuracy.known += other.accuracy.known;
    accuracy.right += other.accuracy.right;
    accuracy.errors_px.insert(accuracy.errors_px.end(), other.accuracy.errors_px.begin(),
                              other.accuracy.errors_px.end());
  }
};

struct Row {
  Column plain, faithful, improved;
  PointAccuracy dense;  ///< of the dense map, at the improved plugin's points
  double dense_ms = 0;

  void add(const Row& other) {
    plain.add(other.plain);
    faithful.add(other.faithful);
    improved.add(other.improved);
    Column sum;
    sum.accuracy = dense;
    sum.add({0, 0, other.dense, 0});
    dense = sum.accuracy;
    dense_ms += other.dense_ms;
  }
};

double figure(const SparseResult& result, std::string_view name, std::string_view unit = "") {
  for (const SparseFigure& f : result.figures)
    if (f.name == name && f.unit == unit) return f.value;
  throw std::logic_error("no figure '" + std::string(name) + "'");
}

Column summary(int features, const std::vector<SparsePoint>& points, const cv::Mat& truth) {
  return {features, static_cast<int>(points.size()), accuracyOf(points, truth), 0};
}

class Comparison {
 public:
  explicit Comparison(int repetitions)
      : repetitions_(repetitions), plugin_(host_.plugin("region-sift")), faithful_(plugin_.settings()) {
    faithful_.set("variant", "faithful");
  }

  Row compare(const TruthPair& pair) {
    Row row;
    std::vector<double> plain_ms, faithful_ms, improved_ms;
    for (int i = 0; i < repetitions_; ++i) {  // in turns: a busy spell of the machine hits all of them
      Stopwatch watch;
      const PlainSiftResult plain = runPlainSift(pair.left, pair.right, pair.calibration);
      plain_ms.push_back(watch.lapMs());
      const SparseResult faithful = plugin_.run(pair.left, pair.right, pair.calibration, faithful_);
      faithful_ms.push_back(watch.lapMs());
      const SparseResult improved = plugin_.run(pair.left, pair.right, pair.calibration, plugin_.settings());
      improved_ms.push_back(watch.lapMs());
      if (i > 0) continue;  // they all find the same each time
      row.plain = summary(plain.features_left, plain.points, pair.truth);
      row.faithful =
          summary(static_cast<int>(figure(faithful, "features left")), faithful.points, pair.truth);
      row.improved =
          summary(static_cast<int>(figure(improved, "features left")), improved.points, pair.truth);
      compareDense(pair, improved.points, row);
    }
    row.plain.ms = medianOf(plain_ms);
    row.faithful.ms = medianOf(faithful_ms);
    row.improved.ms = medianOf(improved_ms);
    return row;
  }

  void drawMap(const TruthPair& pair, const std::string& folder) {
    for (const SparsePicture& picture :
         plugin_.run(pair.left, pair.right, pair.calibration, plugin_.settings()).pictures)
      writeFile(folder + "/region-sift-" + picture.name + ".png", encodeImage(picture.image));
  }

 private:
  static void compareDense(const TruthPair& pair, const std::vector<SparsePoint>& points, Row& row) {
    Options options = Options::preset("balanced");
    options.num_disparities = (pair.calibration.num_disparities + 15) / 16 * 16;
    Stopwatch watch;
    const StereoResult dense = computeDisparity(pair.left, pair.right, options);
    row.dense_ms = watch.lapMs();
    for (const SparsePoint& p : points)
      row.dense.add(truthAt(dense.disparity, p.left_px), truthAt(pair.truth, p.left_px));
  }

  int repetitions_;
  PluginHost host_;
  LoadedPlugin& plugin_;
  PluginSettings faithful_;
};

void writeRow(std::ostream& out, const std::string& name, const Row& row) {
  const auto writeColumn = [&](const Column& c) {
    out << c.features << " | " << c.verified << " | " << c.accuracy.right << " (" << c.accuracy.percentRight()
        << " %) | " << c.ms << " | ";
  };
  out << "| " << name << " | ";
  writeColumn(row.plain);
  writeColumn(row.faithful);
  writeColumn(row.improved);
  const auto gain = [](int now, int before) { return 100.0 * now / std::max(1, before) - 100; };
  out << std::showpos << std::setprecision(0) << gain(row.improved.verified, row.plain.verified) << " % | "
      << gain(row.improved.accuracy.right, row.plain.accuracy.right) << " % | " << std::noshowpos
      << std::setprecision(2) << row.improved.ms / row.plain.ms << " | " << row.improved.accuracy.medianPx()
      << " | " << row.dense.medianPx() << " | " << std::setprecision(1) << row.dense.percentRight() << " % | "
      << row.dense_ms << " |\n";
}

void writeTable(std::ostream& out, const std::vector<TruthPair>& pairs, Comparison& comparison) {
  out << "| pair | plain: features | verified | right | ms | faithful: features | verified | right | ms | "
         "default: "
         "features | verified | right | ms | gain, verified | gain, right | time, default : plain | median "
         "error, "
         "px | dense, px | dense right | dense ms |\n|---|"
      << "--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
      << std::fixed << std::setprecision(1);
  Row total;
  for (const TruthPair& pair : pairs) {
    const Row row = comparison.compare(pair);
    writeRow(out, pair.name, row);
    out << std::setprecision(1);
    total.add(row);
  }
  writeRow(out, "**sum**", total);
}

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

}  // namespace

void writeRegionSiftTable(std::ostream& out, const SparseTableOptions& options) {
  Comparison comparison(options.repetitions);
  const std::vector<TruthPair> rooms = indoorPairs(), real = realPairs(options.scenes);
  out << "## region-sift\n\nRendered rooms with low-contrast floors:\n\n";
  writeTable(out, rooms, comparison);
  if (!real.empty()) {
    out << "\nReal pairs:\n\n";
    writeTable(out, real, comparison);
  }
  writeDistanceTimes(out, rooms.back(), options.repetitions);
  if (!options.pictures.empty()) {
    comparison.drawMap(rooms.back(), options.pictures);
    writeFile(options.pictures + "/region-sift-left.png", encodeImage(rooms.back().left));
  }
}

}  // namespace pomona
