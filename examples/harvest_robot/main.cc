// harvest_robot RIG SOURCE [DRAW_FOLDER | window]: what a harvesting robot does with Pomona. Each frame is
// matched, ripe fruits are found by their colour, and each is measured: a picking list, nearest first.
//
//   RIG          any file that `pomona rig` shows; views that are not rectified are rectified
//   SOURCE       a folder of left*.png and right*.png (.jpg, .bmp); or a video or the number of a camera,
//                with both views side by side
//   DRAW_FOLDER  where the frames with their fruits go; "window": shown as they come
//
// Environment: HARVEST_NEAREST_M, HARVEST_FARTHEST_M (working range, default 0.57 to 1.98).
#include <pomona/engine.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "drawing.h"
#include "pair_stream.h"
#include "picking_list.h"

namespace {

double metresFromEnvironment(const char* name, double otherwise) {
  const char* text = std::getenv(name);
  if (!text) return otherwise;
  char* end = nullptr;
  const double metres = std::strtod(text, &end);
  if (end == text || *end != '\0' || !(metres >= 0.01 && metres <= 1000))
    throw std::runtime_error(cv::format("%s is '%s'; allowed: 0.01 to 1000, in metres", name, text));
  return metres;
}

// The working range fixes the disparities to search: the fewer, the faster.
pomona::Options optionsFor(const pomona::StereoCalibration& c, double nearest_m, double farthest_m) {
  pomona::Options options = pomona::Options::preset("fast");
  options.mode = pomona::OutputMode::kSparse;  // what is only guessed need not be
  constexpr int kMostDisparities = 1024;       // that the engine searches
  const auto refuse = [&](const std::string& allowed) {
    throw std::runtime_error(cv::format("HARVEST_NEAREST_M to HARVEST_FARTHEST_M is %g to %g m; allowed: %s",
                                        nearest_m, farthest_m, allowed.c_str()));
  };
  if (nearest_m >= farthest_m) refuse("the smaller one first");
  const double focal_baseline = c.focal_px * c.baseline_m;
  options.min_disparity = static_cast<int>(std::floor(focal_baseline / farthest_m - c.doffs_px));
  options.num_disparities =
      static_cast<int>(std::ceil(focal_baseline / nearest_m - c.doffs_px)) - options.min_disparity + 1;
  if (options.num_disparities > kMostDisparities)
    refuse(cv::format("at most %d disparities between them, here %d", kMostDisparities,
                      options.num_disparities));
  return options;
}

void print(int frame, const std::vector<Pick>& picks) {
  for (const auto& [box, where] : picks)
    if (where.ok())
      std::printf("frame %d  box %d,%d,%d,%d  %.4f +- %.4f m  centre (%.4f, %.4f, %.4f) m  radius %.1f mm\n",
                  frame, box.x, box.y, box.width, box.height, where.distance_m, where.distance_sigma_m,
                  where.center_m[0], where.center_m[1], where.center_m[2], 1000 * where.radius_m);
    else
      std::printf("frame %d  box %d,%d,%d,%d  not measured: %s\n", frame, box.x, box.y, box.width, box.height,
                  std::string(explain(where.failure)).c_str());
}

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Latency is from a pair that has been read to its picking list.
void printSpeed(std::vector<double> latencies_ms, double loop_ms) {
  if (latencies_ms.empty()) return;
  std::sort(latencies_ms.begin(), latencies_ms.end());
  const auto quantile = [&](double q) {
    return latencies_ms[static_cast<std::size_t>(q * (latencies_ms.size() - 1))];
  };
  std::printf("%.1f frames per second, reading and drawing included; latency p50 %.1f ms, p99 %.1f ms\n",
              1000 * latencies_ms.size() / loop_ms, quantile(0.5), quantile(0.99));
}

int run(const std::string& rig_path, const std::string& source, const std::optional<Drawing>& drawing) {
  const pomona::StereoRig rig = pomona::readRig(rig_path);
  pomona::StereoEngine engine(
      optionsFor(rectificationOf(rig).calibration, metresFromEnvironment("HARVEST_NEAREST_M", 0.57),
                 metresFromEnvironment("HARVEST_FARTHEST_M", 1.98)),
      rig);
  const auto stream = PairStream::open(source);
  // The next pair is read while this one is worked on.
  const auto readNext = [&] { return std::async(std::launch::async, [&] { return stream->next(); }); };
  std::future<std::optional<Pair>> upcoming = readNext();
  std::vector<double> latencies_ms;
  Clock::time_point loop_start;  // the end of the first frame, which makes the buffers
  double loop_ms = 0;
  int frame = 0;
  bool rows_unknown_said = false;
  for (bool go_on = true; go_on; ++frame) {
    const std::optional<Pair> pair = upcoming.get();
    if (!pair) break;
    upcoming = readNext();
    const Clock::time_point start = Clock::now();
    const pomona::StereoResult& result = engine.compute(pair->left, pair->right);
    const std::vector<Pick> picks = pickingList(result, engine.calibration(), engine.leftView());
    if (frame > 0) latencies_ms.push_back(millisecondsSince(start));
    print(frame, picks);
    if (std::isnan(result.row_offset_px) && !std::exchange(rows_unknown_said, true))
      std::printf("frame %d  note: unknown whether rows match (said once); see pomona check\n", frame);
    if (result.rowsAreOff())
      std::printf("frame %d  warning: the right view is %+.1f rows off%s: the rig wants a new calibration\n",
                  frame, result.row_offset_px, result.rows_aligned ? ", and was moved" : "");
    if (drawing) go_on = drawing->show(frame, engine.leftView(), picks);
    if (frame == 0) loop_start = Clock::now();
    loop_ms = millisecondsSince(loop_start);
  }
  if (frame == 0) throw std::runtime_error(source + ": holds no frame");
  printSpeed(std::move(latencies_ms), loop_ms);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::fprintf(stderr, "usage: harvest_robot RIG SOURCE [DRAW_FOLDER | window]\n");
    return 2;
  }
  try {
    return run(argv[1], argv[2], argc == 4 ? std::optional<Drawing>(argv[3]) : std::nullopt);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "harvest_robot: %s\n", e.what());
    return 1;
  }
}
