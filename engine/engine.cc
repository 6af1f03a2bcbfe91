#include "pomona/engine.h"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>

#include "camera/rectify.h"
#include "camera/row_align.h"
#include "camera/row_check.h"
#include "core/cpu.h"
#include "core/parallel.h"
#include "engine/input.h"
#include "engine/pipeline.h"
#include "engine/trust.h"

namespace pomona {
namespace {

template <typename T>
cv::Mat shared(ImageView<T> image, int type) {
  return cv::Mat(image.height, image.width, type, image.data,
                 static_cast<std::size_t>(image.stride) * sizeof(T));
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
  Image<std::uint8_t> right8;  // if rows were moved
  Image<std::uint16_t> right16;
  Pipeline pipeline;
  Trust trust;
  StereoResult result;

  explicit State(const Options& o)
      : options(o),
        isa(chooseIsa(o.isa)),
        threads(o.threads > 0 ? o.threads : availableThreads()),
        pipeline(o, isa, threads) {
    result.timings.reserve(32);
  }
  cv::Mat rectify(const cv::Mat& left_view, const cv::Mat& right_view, const cv::Mat& mask);
  RowOffsets checkRows();
  MatchInput alignedViews(const RowOffsets& rows);
  void publish(const Trust::Maps& estimated);
};

/// Sets `left` and `right`; returns the mask of the rectified left view.
cv::Mat StereoEngine::State::rectify(const cv::Mat& left_view, const cv::Mat& right_view,
                                     const cv::Mat& mask) {
  if (!rectifier) {
    if (calibration && calibration->width > 0)
      for (const auto& [name, view] : {std::pair("left", &left_view), std::pair("right", &right_view)})
        requireView(name, *view, {calibration->width, calibration->height});
    left = left_view;
    right = right_view;
    return mask;
  }
  rectifier->rectify(left_view, right_view, threads);
  left = rectifier->left();
  right = rectifier->right();
  return rectifier->rectifyMask(mask, threads);
}

RowOffsets StereoEngine::State::checkRows() {
  const RowOffsets rows = row_check.measure(input.views().left, input.views().right, options.min_disparity,
                                            options.num_disparities, cameraKernels(isa), threads);
  result.row_offset_px = rows.median_px;
  result.row_error_px = rows.worst_px;
  return rows;
}

/// The pair with the rows of the right view where they are in the left one, as far as that is known.
MatchInput StereoEngine::State::alignedViews(const RowOffsets& rows) {
  MatchInput views = input.views();
  const std::optional<RowOffsetPlane> correction = rowCorrection(rows);
  result.rows_aligned = correction.has_value();
  if (!correction) return views;
  alignRows(views.right, *correction, right8, cameraKernels(isa), threads);
  views.right = right8.view();
  if (views.right16.empty()) return views;
  alignRows(views.right16, *correction, right16, cameraKernels(isa), threads);
  views.right16 = right16.view();
  return views;
}

void StereoEngine::State::publish(const Trust::Maps& estimated) {
  MatchMaps& maps = pipeline.maps();
  result.disparity = shared(maps.disparity.view(), CV_32F);
  result.state = shared(maps.state.view(), CV_8U);
  result.confidence = shared(estimated.confidence, CV_32F);
  result.sigma_px = shared(estimated.sigma_px, CV_32F);
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
  s.input.set(s.left, s.right, s.threads, sgmKernels(s.isa));
  requireRangeFits(s.options.min_disparity, s.options.num_disparities, s.left.cols);
  requireMaskFits(mask, s.left);
  clock.lap("input");
  MatchInput views = s.input.views();
  if (s.options.row_check) {
    const RowOffsets rows = s.checkRows();
    clock.lap("row check");
    if (s.options.align_rows) views = s.alignedViews(rows);
    if (s.result.rows_aligned) clock.lap("row alignment");
  }
  s.pipeline.run(views, maskView(mask), clock);
  const Trust::Maps estimated = s.trust.estimate(s.pipeline.maps(), s.pipeline.largestCostSum(),
                                                 s.pipeline.filterKernels(), s.pipeline.scratch(), s.threads);
  if (s.options.mode == OutputMode::kSparse && s.options.validation.min_confidence > 0)
    Trust::reject(s.pipeline.maps(), estimated, s.options.validation.min_confidence, s.threads);
  clock.lap("confidence");
  s.publish(estimated);
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
