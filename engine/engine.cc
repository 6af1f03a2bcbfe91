#include "pomona/engine.h"

#include <cstdint>
#include <utility>

#include "core/cpu.h"
#include "core/parallel.h"
#include "engine/input.h"
#include "engine/pipeline.h"
#include "engine/trust.h"

namespace pomona {
namespace {

template <typename T>
cv::Mat shared(Image<T>& image, int type) {
  return cv::Mat(image.height(), image.width(), type, image.row(0),
                 static_cast<std::size_t>(image.view().stride) * sizeof(T));
}

}  // namespace

struct StereoEngine::State {
  Options options;
  int threads;
  InputPair input;
  Pipeline pipeline;
  Trust trust;
  StereoResult result;

  explicit State(const Options& o)
      : options(o),
        threads(o.threads > 0 ? o.threads : availableThreads()),
        pipeline(o, chooseIsa(o.isa), threads) {
    result.timings.reserve(32);
  }
  void publish();
};

void StereoEngine::State::publish() {
  MatchMaps& maps = pipeline.maps();
  result.disparity = shared(maps.disparity, CV_32F);
  result.state = shared(maps.state, CV_8U);
  result.confidence = shared(trust.confidence, CV_32F);
  result.sigma_px = shared(trust.sigma_px, CV_32F);
}

StereoEngine::StereoEngine(const Options& options) {
  options.validate();
  state_ = std::make_unique<State>(options);
}
StereoEngine::~StereoEngine() = default;
StereoEngine::StereoEngine(StereoEngine&&) noexcept = default;
StereoEngine& StereoEngine::operator=(StereoEngine&&) noexcept = default;

const Options& StereoEngine::options() const {
  return state_->options;
}

const StereoResult& StereoEngine::compute(const cv::Mat& left, const cv::Mat& right, const cv::Mat& mask) {
  State& s = *state_;
  StageClock clock(s.result.timings);
  s.input.set(left, right, s.threads);
  requireRangeFits(s.options.min_disparity, s.options.num_disparities, left.cols);
  requireMaskFits(mask, left);
  clock.lap("input");
  s.pipeline.run(s.input.views(), maskView(mask), clock);
  s.trust.estimate(s.pipeline.maps(), s.pipeline.largestCostSum(), s.threads);
  if (s.options.mode == OutputMode::kSparse && s.options.validation.min_confidence > 0)
    s.trust.reject(s.pipeline.maps(), s.options.validation.min_confidence, s.threads);
  clock.lap("confidence");
  s.publish();
  return s.result;
}

StereoResult computeDisparity(const cv::Mat& left, const cv::Mat& right, const Options& options,
                              const cv::Mat& mask) {
  StereoEngine engine(options);
  StereoResult result = engine.compute(left, right, mask);
  for (cv::Mat* map : {&result.disparity, &result.state, &result.confidence, &result.sigma_px})
    *map = map->clone();
  return result;
}

}  // namespace pomona
