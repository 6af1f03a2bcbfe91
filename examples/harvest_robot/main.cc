// harvest_robot RIG SOURCE [DRAW_FOLDER | window]: what a harvesting robot does with Pomona. Each frame is
// matched, ripe fruits are found by their colour, and each is measured: a picking list, nearest first.
//
//   RIG          any file that `pomona rig` shows; views that are not rectified are rectified
//   SOURCE       a folder of left*.png and right*.png, a video or the number of a camera (side by side)
//   DRAW_FOLDER  where the frames with their fruits go; "window": shown as they come
//
// Environment: HARVEST_NEAREST_M, HARVEST_FARTHEST_M (working range, default 0.57 to 1.98).
#include <pomona/engine.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <opencv2/highgui.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "pair_stream.h"
#include "picking_list.h"

namespace {

double metresFromEnvironment(const char* name, double otherwise) {
  const char* text = std::getenv(name);
  if (!text) return otherwise;
  char* end = nullptr;
  const double metres = std::strtod(text, &end);
  if (end == text || *end != '\0' || !std::isfinite(metres) || metres <= 0)
    throw std::runtime_error(cv::format("%s is '%s'; allowed: metres, above 0", name, text));
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

cv::Mat draw(const cv::Mat& bgr, const std::vector<Pick>& picks) {
  cv::Mat picture = bgr.clone();
  for (const auto& [box, where] : picks) {
    const cv::Scalar color = where.ok() ? cv::Scalar(255, 255, 255) : cv::Scalar(128, 128, 128);
    cv::rectangle(picture, box, color, 2);
    const std::string text = where.ok() ? cv::format("%.0f +- %.0f mm", 1000 * where.distance_m,
                                                     std::ceil(2000 * where.distance_sigma_m))
                                        : "?";
    cv::putText(picture, text, box.tl() + cv::Point(0, -6), cv::FONT_HERSHEY_SIMPLEX, 0.5, color, 1,
                cv::LINE_AA);
  }
  return picture;
}

int run(const std::string& rig_path, const std::string& source, const std::string& drawing) {
  const pomona::StereoRig rig = pomona::readRig(rig_path);
  pomona::StereoEngine engine(
      optionsFor(rectificationOf(rig).calibration, metresFromEnvironment("HARVEST_NEAREST_M", 0.57),
                 metresFromEnvironment("HARVEST_FARTHEST_M", 1.98)),
      rig);
  const auto stream = PairStream::open(source);
  std::vector<double> milliseconds;
  cv::Mat left, right;
  for (int frame = 0; stream->next(left, right); ++frame) {
    const auto start = std::chrono::steady_clock::now();
    const pomona::StereoResult& result = engine.compute(left, right);
    const std::vector<Pick> picks = pickingList(result, engine.calibration(), engine.leftView());
    milliseconds.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    print(frame, picks);
    if (result.rowsAreOff())
      std::printf("frame %d  warning: the right view is %+.1f rows off%s: the rig wants a new calibration\n",
                  frame, result.row_offset_px, result.rows_aligned ? ", and was moved" : "");
    if (drawing == "window") {
      cv::imshow("harvest", draw(engine.leftView(), picks));
      if (cv::waitKey(1) == 27) break;  // escape
    } else if (!drawing.empty()) {
      const std::string file = cv::format("%s/frame%04d.png", drawing.c_str(), frame);
      if (!cv::imwrite(file, draw(engine.leftView(), picks)))
        throw std::runtime_error(file + ": cannot be written");
    }
  }
  if (milliseconds.size() > 1) milliseconds.erase(milliseconds.begin());  // the first frame makes the buffers
  std::sort(milliseconds.begin(), milliseconds.end());
  double sum = 0;
  for (const double ms : milliseconds) sum += ms;
  const auto quantile = [&](double q) {
    return milliseconds[static_cast<std::size_t>(q * (milliseconds.size() - 1))];
  };
  if (!milliseconds.empty())
    std::printf("%.1f frames per second, latency p50 %.1f ms, p99 %.1f ms (without reading and drawing)\n",
                1000 * milliseconds.size() / sum, quantile(0.5), quantile(0.99));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::fprintf(stderr, "usage: harvest_robot RIG SOURCE [DRAW_FOLDER | window]\n");
    return 2;
  }
  try {
    return run(argv[1], argv[2], argc == 4 ? argv[3] : "");
  } catch (const std::exception& e) {
    std::fprintf(stderr, "harvest_robot: %s\n", e.what());
    return 1;
  }
}
