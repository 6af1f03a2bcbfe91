// The table of logo-range: a sign found and ranged in 28 rendered shop fronts.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>

#include "bench/sparse/object_scenes.h"
#include "bench/sparse/tables.h"
#include "bench/sparse/temporary_folder.h"
#include "datasets/atomic_file.h"
#include "datasets/hash.h"
#include "datasets/image_file.h"
#include "plugins/logo_range/box_range.h"
#include "pomona/engine.h"
#include "pomona/measure.h"
#include "pomona/plugin_host.h"

namespace pomona {
namespace {

struct Ranged {
  double distance_m = 0, sigma_m = 0, bearing_deg = 0;
};

// Distances found by one way of ranging.
class Way {
 public:
  explicit Way(std::string name) : name_(std::move(name)) {}

  void add(const SignScene& scene, const std::optional<Ranged>& ranged, double ms) {
    const std::size_t steep = static_cast<std::size_t>(std::lround(std::abs(scene.yaw_deg) / 15));
    ++scenes_[steep];
    ms_ += ms;
    if (!ranged) return;
    ++found_[steep];
    const double off_m = ranged->distance_m - scene.distance_m;
    percent_.push_back(100 * std::abs(off_m) / scene.distance_m);
    within_ += std::abs(off_m) <= 2 * ranged->sigma_m;
    bearing_deg_ += std::abs(ranged->bearing_deg - scene.bearing_deg);
  }

  void write(std::ostream& out) const {
    const double n = static_cast<double>(percent_.size());
    double sum = 0, most = 0;
    for (const double p : percent_) sum += p, most = std::max(most, p);
    int scenes = 0;
    for (const int count : scenes_) scenes += count;
    char line[256];
    std::snprintf(
        line, sizeof(line), "| %s | %d/%d | %d/%d %d/%d %d/%d %d/%d | %.2f | %.2f | %.2f | %.0f | %.0f |\n",
        name_.c_str(), int(percent_.size()), scenes, found_[0], scenes_[0], found_[1], scenes_[1], found_[2],
        scenes_[2], found_[3], scenes_[3], sum / n, most, bearing_deg_ / n, 100 * within_ / n, ms_ / scenes);
    out << line;
  }

 private:
  std::string name_;
  int found_[4] = {}, scenes_[4] = {};  // by |yaw| / 15 degrees
  std::vector<double> percent_;
  double bearing_deg_ = 0, within_ = 0, ms_ = 0;
};

double millisecondsOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::optional<Ranged> rangedOf(const SparseResult& result) {
  if (result.objects.size() != 1 || !result.objects[0].found()) return std::nullopt;
  const SparseObject& object = result.objects[0];
  return Ranged{object.distance_m, object.sigma_m, object.bearing_deg};
}

// What a detector's box would be: the sign's, off by up to 5 % of its sides at each edge.
cv::Rect2f jittered(const cv::Rect2f& box, Random& random) {
  const auto off = [&](float side) { return static_cast<float>(random.between(-0.05, 0.05)) * side; };
  const cv::Point2f first = box.tl() + cv::Point2f(off(box.width), off(box.height));
  return {first, box.br() + cv::Point2f(off(box.width), off(box.height))};
}

// The plugin, looking for one picture.
class SignFinder {
 public:
  explicit SignFinder(const cv::Mat& picture) {
    writeFile(folder_.file("sign.png"), encodeImage(picture));
    plugin_ = &host_.plugin("logo-range");
  }

  void add(const SignScene& scene, Way& way, const std::string& variant) {
    PluginSettings settings = plugin_->settings();
    settings.set("variant", variant);
    settings.set("objects", folder_.file("sign.png"));
    const auto run = [&] {
      return plugin_->run(scene.pair.left.image, scene.pair.right.image, scene.pair.calibration, settings);
    };
    if (learned_ != variant) run();  // learns the picture, outside of what is timed
    learned_ = variant;
    SparseResult result;
    const double ms = millisecondsOf([&] { result = run(); });
    way.add(scene, rangedOf(result), ms);
  }

 private:
  TemporaryFolder folder_;
  PluginHost host_;
  LoadedPlugin* plugin_ = nullptr;
  std::string learned_;
};

constexpr const char* kHead =
    "| | found | at 0, 15, 30, 45 degrees | mean error, % | largest, % | bearing off, degrees | "
    "within 2 sigma, % | ms |\n|---|--:|---|--:|--:|--:|--:|--:|\n";

class Comparison {
 public:
  void add(int number) {
    const SignScene scene = signScene(number);
    finder_.add(scene, faithful_, "faithful");
    finder_.add(scene, default_, "default");
    StereoResult dense;
    Options options = Options::preset("balanced");
    options.num_disparities = scene.pair.calibration.num_disparities;
    const double dense_ms = millisecondsOf(
        [&] { dense = computeDisparity(scene.pair.left.image, scene.pair.right.image, options); });
    addOutline(scene, dense, dense_ms);
    addBoxes(scene, dense, dense_ms, static_cast<std::uint64_t>(number));
  }

  void write(std::ostream& out) const {
    out << kHead << "| published, SURF | | none beyond 30 | 12 | | | | |\n";
    faithful_.write(out);
    default_.write(out);
    outline_.write(out);
    out << "| published, detector's boxes | | | 29 | | | | |\n";
    centers_.write(out);
    boxes_.write(out);
  }

 private:
  void addOutline(const SignScene& scene, const StereoResult& dense, double dense_ms) {
    MeasureOptions options;
    options.shape = ObjectShape::kSurface;
    const ObjectMeasurement m =
        measureObject(dense, scene.pair.calibration, Polygon(scene.outline_px), options);
    std::optional<Ranged> ranged;
    if (m.ok()) ranged = {m.distance_m, m.distance_sigma_m, m.azimuth_rad * 180 / CV_PI};
    outline_.add(scene, ranged, dense_ms);
  }

  void addBoxes(const SignScene& scene, const StereoResult& dense, double dense_ms, std::uint64_t seed) {
    Random random(seed);
    const Boxes boxes{{{0, 1, jittered(scene.left_box_px, random)}},
                      {{0, 1, jittered(scene.right_box_px, random)}}};
    const auto run = [&](BoxRanging ranging) {
      return rangedOf(rangeBoxes(
          boxes, scene.pair.calibration, ranging, [&]() -> const StereoResult& { return dense; },
          [](int) { return "sign"; }));
    };
    centers_.add(scene, run(BoxRanging::kCenters), 0);
    boxes_.add(scene, run(BoxRanging::kDense), dense_ms);
  }

  SignFinder finder_{signPicture()};
  Way faithful_{"`variant=faithful`"}, default_{"default"},
      outline_{"dense map (`balanced`) in the true outline"};
  Way centers_{"boxes off by up to 5 %, `box_ranging=centers`"},
      boxes_{"the same boxes, `box_ranging=dense`"};
};

}  // namespace

void writeLogoRangeTable(std::ostream& out, const SparseTableOptions& options) {
  out << "## logo-range\n\n28 rendered shop fronts, 5.48 to 14.63 m, yaw -45 to 45 degrees.\n\n";
  Comparison comparison;
  for (int i = 0; i < kSignScenes; ++i) comparison.add(i);
  comparison.write(out);
  if (!options.pictures.empty())
    writeFile(options.pictures + "/shop-front.png", encodeImage(signScene(13).pair.left.image));
}

void writeOtherSignsTable(std::ostream& out, const SparseTableOptions&) {
  constexpr double kDepths_m[] = {6, 10, 14}, kYaws_deg[] = {-45, 30, 45};
  out << "## Other signs\n\nSigns of the renderer's own, learned from a view of them 4 m away.\n\n" << kHead;
  for (const bool wide : {true, false}) {
    const std::string signs = wide ? ", wide signs" : ", small signs";
    Way faithful("`variant=faithful`" + signs), by_default("default" + signs);
    for (std::uint64_t seed = 301; seed <= 302; ++seed) {
      const StreetSign sign = streetSign(seed, wide);
      SignFinder finder(sign.picture);
      std::vector<SignScene> scenes;
      for (const double depth_m : kDepths_m)
        for (const double yaw_deg : kYaws_deg)
          scenes.push_back(signScene(sign, depth_m, yaw_deg, 10 * seed + scenes.size()));
      for (const SignScene& scene : scenes) finder.add(scene, faithful, "faithful");
      for (const SignScene& scene : scenes) finder.add(scene, by_default, "default");
    }
    faithful.write(out);
    by_default.write(out);
  }
}

}  // namespace pomona
