#include "baselines/window_method.h"

#include "baselines/post_process.h"
#include "baselines/stopwatch.h"
#include "engine/input.h"

namespace pomona {
namespace {

template <typename T>
cv::Mat copyOf(Image<T>& image, int type) {
  return cv::Mat(image.height(), image.width(), type, image.row(0),
                 static_cast<std::size_t>(image.view().stride) * sizeof(T))
      .clone();
}

}  // namespace

MethodResult WindowMethod::run(const cv::Mat& left, const cv::Mat& right, const MethodOptions& options) {
  const Stopwatch watch;
  Options engine_options;
  engine_options.min_disparity = options.min_disparity;
  engine_options.num_disparities = options.num_disparities;
  engine_options.threads = options.threads;
  engine_options.validation.left_right_px = 1;  // a window's sums tell right from wrong less well than paths
  engine_options.validation = options.post_processing.over(engine_options.validation);
  engine_options.validate();
  const int threads = options.threads > 0 ? options.threads : availableThreads();
  InputPair input;
  input.set(left, right, threads);
  requireRangeFits(options.min_disparity, options.num_disparities, left.cols);

  const SearchRange range{options.min_disparity, options.num_disparities};
  const auto position = options.raw ? WinnerPosition::kWhole : WinnerPosition::kParabola;
  WindowMaps maps = match(left, right, range, position, threads);
  if (!options.raw) {
    validate(maps, range, engine_options.validation, threads);
    if (options.mode == OutputMode::kDense) fill(maps, input.views().guide, range, threads);
  }
  return {copyOf(maps.disparity, CV_32F), copyOf(maps.state, CV_8U), copyOf(maps.confidence, CV_32F),
          watch.milliseconds()};
}

}  // namespace pomona
