#include "pomona/engine.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "camera/rectify.h"
#include "camera/row_check.h"
#include "core/cpu.h"
#include "core/parallel.h"
#include "engine/coarse_stage.h"
#include "engine/confidence.h"
#include "engine/hierarchical_mi.h"
#include "engine/input.h"
#include "engine/refinement.h"
#include "engine/sparse_stage.h"
#include "pyramid/hole_fill.h"
#include "pyramid/plane_fill.h"

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
  Isa isa;
  int threads;

  std::optional<StereoCalibration> calibration;
  std::optional<Rectifier> rectifier;  // if the views need one
  cv::Mat left, right;                 // rectified
  InputPair input;
  RowCheck row_check;
  HierarchicalMi mutual_information;
  SparseStage sparse;
  CoarseStage coarse;
  PlaneFillScratch plane_fill;
  HoleFillScratch hole_fill;
  Refinement refinement;
  Image<float> first_map;
  Image<float> confidence;
  StereoResult result;

  explicit State(const Options& o) : options(o), isa(chooseIsa(o.isa)) {
    threads = o.threads > 0 ? o.threads : availableThreads();
    result.timings.reserve(32);
  }
  SparseStage::Settings settings(const cv::Mat& mask) const;
  bool completesBy(CompletionMethod method) const {
    return options.mode == OutputMode::kDense && options.completion.method == method;
  }
  cv::Mat rectify(const cv::Mat& left_view, const cv::Mat& right_view, const cv::Mat& mask);
  void checkRows();
  void fillWithCoarse(const SparseStage::Settings& settings);
  void complete(const SparseStage::Settings& settings, StageClock& clock);
  void matchAgain(const SparseStage::Settings& settings, StageClock& clock);
  void clampToRange();
  void publish();
};

SparseStage::Settings StereoEngine::State::settings(const cv::Mat& mask) const {
  SparseStage::Settings s;
  s.match = {options.min_disparity, options.num_disparities, options.cost, options.aggregation,
             options.winner};
  s.validation = options.validation;
  if (completesBy(CompletionMethod::kFillHoles)) {
    s.validation.left_right_px = options.completion.seed_left_right_px;
    s.validation.speckle_size_px = options.completion.seed_speckle_size_px;
  }
  if (!mask.empty())
    s.mask = {mask.ptr<std::uint8_t>(), mask.cols, mask.rows, static_cast<std::ptrdiff_t>(mask.step1())};
  s.isa = isa;
  s.threads = threads;
  return s;
}

/// Sets `left` and `right`; returns the mask of the rectified left view.
cv::Mat StereoEngine::State::rectify(const cv::Mat& left_view, const cv::Mat& right_view,
                                     const cv::Mat& mask) {
  if (!rectifier) {
    left = left_view;
    right = right_view;
    return mask;
  }
  rectifier->rectify(left_view, right_view, threads);
  left = rectifier->left();
  right = rectifier->right();
  return rectifier->rectifyMask(mask, threads);
}

void StereoEngine::State::checkRows() {
  result.row_offset_px = result.row_error_px = std::numeric_limits<float>::quiet_NaN();
  if (!options.row_check) return;
  const RowOffsets rows = row_check.measure(input.views().left, input.views().right, options.min_disparity,
                                            options.num_disparities);
  result.row_offset_px = rows.median_px;
  result.row_error_px = rows.worst_px;
}

/// The paper's dense map: every pixel from the coarse scales.
void StereoEngine::State::fillWithCoarse(const SparseStage::Settings& settings) {
  MatchMaps& maps = sparse.maps();
  maps.resize(input.width(), input.height());
  const ImageView<const float> map = coarse.run(input.views(), settings, options.completion);
  parallelStrips(threads, map.height, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < map.width; ++x) {
        const bool masked = !settings.mask.empty() && settings.mask.at(y, x) == 0;
        const float d = map.at(y, x);
        maps.state.row(y)[x] =
            static_cast<std::uint8_t>(masked ? PixelState::kMasked : PixelState::kFilledCoarse);
        maps.disparity.row(y)[x] = masked          ? std::numeric_limits<float>::quiet_NaN()
                                   : std::isnan(d) ? static_cast<float>(options.min_disparity)
                                                   : d;
      }
  });
}

void StereoEngine::State::complete(const SparseStage::Settings& settings, StageClock& clock) {
  MatchMaps& maps = sparse.maps();
  const CompletionOptions& completion = options.completion;
  const float min_disparity = static_cast<float>(options.min_disparity);
  if (completion.segment_planes)
    fillFromPlanes({.guide = input.views().guide,
                    .right_disparity = maps.right_disparity.view(),
                    .scale = completion.segment_scale,
                    .min_disparity = min_disparity,
                    .max_disparity = static_cast<float>(options.min_disparity + options.num_disparities - 1)},
                   maps.disparity.view(), maps.state.view(), plane_fill, pyramidKernels(isa), threads);
  clock.lap("segment planes");
  const auto coarse_map = [&] { return coarse.run(input.views(), settings, completion); };
  fillHoles({.guide = input.views().guide,
             .right_disparity = maps.right_disparity.view(),
             .coarse = coarse_map,
             .search_radius_px = completion.search_radius_px,
             .fallback_disparity = min_disparity},
            maps.disparity.view(), maps.state.view(), hole_fill, pyramidKernels(isa), threads);
  clock.lap("hole filling");
  refinement.run(maps.disparity, input.views().guide, options.completion, filterKernels(isa), threads, clock);
}

/// Filling and smoothing may overshoot; no disparity leaves the searched range.
void StereoEngine::State::clampToRange() {
  Image<float>& disparity = sparse.maps().disparity;
  const float low = static_cast<float>(options.min_disparity);
  const float high = static_cast<float>(options.min_disparity + options.num_disparities - 1);
  parallelStrips(threads, disparity.height(), 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < disparity.width(); ++x) {
        float& d = disparity.row(y)[x];
        d = d < low ? low : d > high ? high : d;  // NaN stays
      }
  });
}

/// The second pass: the completed map, which sparse.maps() holds, becomes the prior of another match.
void StereoEngine::State::matchAgain(const SparseStage::Settings& settings, StageClock& clock) {
  std::swap(first_map, sparse.maps().disparity);
  MatchInput views = input.views();
  views.prior = first_map.view();
  SparseStage::Settings again = settings;
  again.match.cost = options.second_pass.cost;
  again.match.aggregation = options.second_pass.aggregation;
  again.match.prior_weight = options.second_pass.weight;
  again.match.prior_reach_px = options.second_pass.reach_px;
  sparse.run(views, again, clock);
  complete(settings, clock);
}

void StereoEngine::State::publish() {
  MatchMaps& maps = sparse.maps();
  result.disparity = shared(maps.disparity, CV_32F);
  result.state = shared(maps.state, CV_8U);
  result.confidence = shared(confidence, CV_32F);
}

StereoEngine::StereoEngine(const Options& options) {
  options.validate();
  state_ = std::make_unique<State>(options);
}
StereoEngine::StereoEngine(const Options& options, const StereoRig& rig) : StereoEngine(options) {
  state_->calibration = rectificationOf(rig).calibration;
  if (!rig.isRectified()) state_->rectifier.emplace(rig);
}
StereoEngine::~StereoEngine() = default;
StereoEngine::StereoEngine(StereoEngine&&) noexcept = default;
StereoEngine& StereoEngine::operator=(StereoEngine&&) noexcept = default;

const Options& StereoEngine::options() const {
  return state_->options;
}

const StereoCalibration& StereoEngine::calibration() const {
  if (!state_->calibration) throw std::logic_error("calibration: the engine was made without a rig");
  return *state_->calibration;
}
const cv::Mat& StereoEngine::leftView() const {
  return state_->left;
}
const cv::Mat& StereoEngine::rightView() const {
  return state_->right;
}

const StereoResult& StereoEngine::compute(const cv::Mat& left_view, const cv::Mat& right_view,
                                          const cv::Mat& given_mask) {
  State& s = *state_;
  StageClock clock(s.result.timings);
  const cv::Mat mask = s.rectify(left_view, right_view, given_mask);
  if (s.rectifier) clock.lap("rectification");
  s.input.set(s.left, s.right, s.threads);
  requireRangeFits(s.options.min_disparity, s.options.num_disparities, s.left.cols);
  requireMaskFits(mask, s.left);
  SparseStage::Settings settings = s.settings(mask);
  clock.lap("input");
  s.checkRows();
  if (s.options.row_check) clock.lap("row check");

  const AggregationOptions* last_match = &s.options.aggregation;  // the one that the margins come from
  if (s.completesBy(CompletionMethod::kPaper)) {
    s.fillWithCoarse(settings);
    clock.lap("coarse maps");
  } else {
    if (s.options.cost.cost == MatchingCost::kMutualInformation) {
      settings.mutual_information = s.mutual_information.table(s.input.views(), settings);
      clock.lap("mutual information");
    }
    s.sparse.run(s.input.views(), settings, clock);
    if (s.completesBy(CompletionMethod::kFillHoles)) {
      s.complete(settings, clock);
      if (s.options.second_pass.enabled) {
        s.matchAgain(settings, clock);
        last_match = &s.options.second_pass.aggregation;
      }
    }
  }
  if (s.options.mode == OutputMode::kDense) s.clampToRange();
  estimateConfidence(s.sparse.maps(), *last_match, s.confidence, s.threads);
  clock.lap("confidence");
  s.publish();
  return s.result;
}

StereoResult computeDisparity(const cv::Mat& left, const cv::Mat& right, const Options& options) {
  StereoEngine engine(options);
  StereoResult result = engine.compute(left, right);
  for (cv::Mat* map : {&result.disparity, &result.state, &result.confidence}) *map = map->clone();
  return result;
}

}  // namespace pomona
