// Pomona's own presets.
#include <array>
#include <optional>
#include <string>

#include "baselines/method.h"
#include "baselines/stopwatch.h"
#include "pomona/engine.h"

namespace pomona {

namespace {

class Preset : public Method {
 public:
  explicit Preset(std::string_view name) : name_(name) {}

  MethodResult run(const cv::Mat& left, const cv::Mat& right, const MethodOptions& options) override {
    if (!engine_ || !(options == engine_options_)) {
      engine_.emplace(engineOptions(options));
      engine_options_ = options;
    }
    const Stopwatch watch;
    const StereoResult& result = engine_->compute(left, right);
    const double milliseconds = watch.milliseconds();
    return {result.disparity.clone(), result.state.clone(), result.confidence.clone(), milliseconds};
  }

 private:
  Options engineOptions(const MethodOptions& options) const {
    Options o = Options::preset(name_);
    o.min_disparity = options.min_disparity;
    o.num_disparities = options.num_disparities;
    o.mode = options.mode;
    o.threads = options.threads;
    const PostProcessing& post = options.post_processing;
    o.validation = post.over(o.validation);
    o.completion.seed_left_right_px = post.left_right_px.value_or(o.completion.seed_left_right_px);
    o.completion.seed_speckle_size_px = post.speckle_size_px.value_or(o.completion.seed_speckle_size_px);
    if (options.raw) {
      o.mode = OutputMode::kSparse;
      o.winner = {.subpixel = SubpixelMethod::kNone, .uniqueness_percent = 0};
      o.validation.left_right_px = -1;
      o.validation.speckle_size_px = 0;
      o.validation.median_size = 0;
    }
    return o;
  }

  std::string_view name_;
  std::optional<StereoEngine> engine_;
  MethodOptions engine_options_;  // what engine_ was made for
};

constexpr MethodInfo kMethods[] = {
    {"fast", "Pomona, for speed", [] { return std::unique_ptr<Method>(new Preset("fast")); }},
    {"balanced", "Pomona's default", [] { return std::unique_ptr<Method>(new Preset("balanced")); }},
    {"quality", "Pomona, for accuracy", [] { return std::unique_ptr<Method>(new Preset("quality")); }},
    {"paper", "the seed method: mutual information at 1/4 and 1/5 scale, equal-weight fusion",
     [] { return std::unique_ptr<Method>(new Preset("paper")); }},
};

}  // namespace

std::span<const MethodInfo> presetMethods() {
  return kMethods;
}

}  // namespace pomona
