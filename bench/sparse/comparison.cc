#include "bench/sparse/comparison.h"

#include <algorithm>
#include <iomanip>
#include <stdexcept>

#include "bench/sparse/plain_sift.h"
#include "plugins/common/stopwatch.h"
#include "pomona/engine.h"
#include "pomona/plugin_host.h"

namespace pomona {
namespace {

/// One way of finding points.
struct Column {
  int features = 0, verified = 0;  ///< features of the left view
  PointAccuracy accuracy;
  double ms = 0;

  void add(const Column& other) {
    features += other.features;
    verified += other.verified;
    accuracy.add(other.accuracy);
    ms += other.ms;
  }
};

struct Row {
  Column plain, faithful, improved;
  Column dense;  ///< the dense map at the improved plugin's points

  void add(const Row& other) {
    plain.add(other.plain);
    faithful.add(other.faithful);
    improved.add(other.improved);
    dense.add(other.dense);
  }
};

int leftFeatures(const SparseResult& result) {
  for (const SparseFigure& f : result.figures)
    if (f.name == "features left") return static_cast<int>(f.value);
  throw std::logic_error("the plugin gives no figure 'features left'");
}

Column summary(int features, const std::vector<SparsePoint>& points, const cv::Mat& truth) {
  return {features, static_cast<int>(points.size()), accuracyOf(points, truth), 0};
}

Column denseAt(const std::vector<SparsePoint>& points, const TruthPair& pair) {
  Options options = Options::preset("balanced");
  options.num_disparities = (pair.calibration.num_disparities + 15) / 16 * 16;
  Column column;
  Stopwatch watch;
  const StereoResult dense = computeDisparity(pair.left, pair.right, options);
  column.ms = watch.lapMs();
  for (const SparsePoint& p : points)
    column.accuracy.add(truthAt(dense.disparity, p.left_px), truthAt(pair.truth, p.left_px));
  return column;
}

Row compare(LoadedPlugin& plugin, const TruthPair& pair, int repetitions) {
  const PluginSettings defaults = plugin.settings();
  PluginSettings as_published = defaults;
  as_published.set("variant", "faithful");
  Row row;
  std::vector<double> plain_ms, faithful_ms, improved_ms;
  for (int i = 0; i < repetitions; ++i) {  // in turns: a busy spell of the machine hits all of them
    Stopwatch watch;
    const PlainSiftResult plain = runPlainSift(pair.left, pair.right, pair.calibration);
    plain_ms.push_back(watch.lapMs());
    const SparseResult faithful = plugin.run(pair.left, pair.right, pair.calibration, as_published);
    faithful_ms.push_back(watch.lapMs());
    const SparseResult improved = plugin.run(pair.left, pair.right, pair.calibration, defaults);
    improved_ms.push_back(watch.lapMs());
    if (i > 0) continue;  // they all find the same each time
    row.plain = summary(plain.features_left, plain.points, pair.truth);
    row.faithful = summary(leftFeatures(faithful), faithful.points, pair.truth);
    row.improved = summary(leftFeatures(improved), improved.points, pair.truth);
    row.dense = denseAt(improved.points, pair);
  }
  row.plain.ms = medianOf(plain_ms);
  row.faithful.ms = medianOf(faithful_ms);
  row.improved.ms = medianOf(improved_ms);
  return row;
}

void writeRow(std::ostream& out, const std::string& name, const Row& row) {
  out << "| " << name << std::setprecision(1);
  for (const Column* c : {&row.plain, &row.faithful, &row.improved})
    out << " | " << c->features << ", " << c->verified << ", " << c->accuracy.percentRight() << " %";
  const auto gain = [](int now, int before) { return 100.0 * now / std::max(1, before) - 100; };
  out << std::showpos << std::setprecision(0) << " | " << gain(row.improved.verified, row.plain.verified)
      << " % | " << gain(row.improved.accuracy.right, row.plain.accuracy.right) << " %" << std::noshowpos;
  for (const Column* c : {&row.plain, &row.faithful, &row.improved, &row.dense}) out << " | " << c->ms;
  out << std::setprecision(2) << " | " << row.improved.ms / row.plain.ms << " | "
      << row.improved.accuracy.medianPx() << " | " << row.dense.accuracy.medianPx() << std::setprecision(1)
      << ", " << row.dense.accuracy.percentRight() << " % |\n";
}

}  // namespace

void writePointComparison(std::ostream& out, const std::string& plugin, const std::vector<TruthPair>& pairs,
                          int repetitions) {
  PluginHost host;
  LoadedPlugin& loaded = host.plugin(plugin);
  out << "| pair | plain SIFT: features, verified, right | faithful | default | gain, verified | gain, right "
         "| plain, ms | faithful, ms | default, ms | dense, ms | default : plain | default: median, px | "
         "dense "
         "there: median, px, right |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
      << std::fixed;
  Row total;
  for (const TruthPair& pair : pairs) {
    const Row row = compare(loaded, pair, repetitions);
    writeRow(out, pair.name, row);
    total.add(row);
  }
  writeRow(out, "**all**", total);
}

}  // namespace pomona
