#include "pomona/options.h"

#include <charconv>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <string>

#include "core/cpu.h"
#include "sgm/kernels.h"

namespace pomona {
namespace {

std::string text(double v) {
  char digits[32];
  return {digits, std::to_chars(std::begin(digits), std::end(digits), v).ptr};
}

[[noreturn]] void refuse(const std::string& field, double value, const std::string& allowed) {
  throw std::invalid_argument(field + " is " + text(value) + "; allowed: " + allowed);
}

/// NaN fails every range.
void requireRange(const std::string& field, double value, double low, double high) {
  if (!(value >= low && value <= high)) refuse(field, value, text(low) + " to " + text(high));
}

void requireOneOf(const std::string& field, int value, std::initializer_list<int> allowed) {
  std::string list;
  for (int a : allowed) {
    if (a == value) return;
    list += (list.empty() ? "" : ", ") + std::to_string(a);
  }
  refuse(field, value, list);
}

template <typename Enum>
void requireEnum(const std::string& field, Enum value, Enum last) {
  requireRange(field, static_cast<int>(value), 0, static_cast<int>(last));
}

/// `prior`: what else the matching cost can grow by.
void validateMatch(const std::string& prefix, const CostOptions& cost, const AggregationOptions& aggregation,
                   int prior) {
  const auto field = [&](const char* name) { return prefix + name; };
  requireEnum(field("cost.cost"), cost.cost, MatchingCost::kBlended);
  requireRange(field("cost.support_color_step"), cost.support_color_step, 0, 255);
  requireOneOf(field("aggregation.paths"), aggregation.paths, {4, 8});
  requireEnum(field("aggregation.adaptation"), aggregation.adaptation, PenaltyAdaptation::kSoftIntensity);
  const int budget = 255 - maximumCost(cost.cost) - prior;
  requireRange(field("aggregation.p1"), aggregation.p1, 1, budget / 2);
  if (aggregation.p2 < aggregation.p1 || aggregation.p2 > budget - aggregation.p1)
    refuse(field("aggregation.p2"), aggregation.p2,
           text(aggregation.p1) + " to " + text(budget - aggregation.p1) +
               " (p1 <= p2, and largest matching cost + p1 + p2 <= 255)");
  if (aggregation.adaptation == PenaltyAdaptation::kSoftIntensity)
    requireRange(field("aggregation.p2_min"), aggregation.p2_min, aggregation.p1, aggregation.p2);
}

}  // namespace

void Options::validate() const {
  requireRange("min_disparity", min_disparity, -16384, 16384);
  requireRange("num_disparities", num_disparities, 1, kMaxDisparities);
  requireEnum("mode", mode, OutputMode::kDense);
  if (adaptive_range && mode == OutputMode::kDense && completion.method == CompletionMethod::kPaper)
    throw std::invalid_argument(
        "adaptive_range is on, mode is dense and completion.method is paper, which matches nothing at full "
        "size; allowed: off");
  requireEnum("memory", memory, MemoryMode::kLow);
  requireRange("threads", threads, 0, 1024);
  chooseIsa(isa);

  validateMatch("", cost, aggregation, 0);
  if (second_pass.enabled) {
    requireRange("second_pass.weight", second_pass.weight, 1, 16);
    requireRange("second_pass.reach_px", second_pass.reach_px, 1, 16);
    if (second_pass.cost.cost == MatchingCost::kMutualInformation)
      throw std::invalid_argument(
          "second_pass.cost.cost is mutual information; allowed: the census costs, blended");
    validateMatch("second_pass.", second_pass.cost, second_pass.aggregation,
                  second_pass.weight * second_pass.reach_px);
  }

  requireEnum("winner.subpixel", winner.subpixel, SubpixelMethod::kFitted);
  requireRange("winner.uniqueness_percent", winner.uniqueness_percent, 0, 100);

  requireRange("validation.left_right_px", validation.left_right_px, -1e6, 1e6);
  requireRange("validation.speckle_size_px", validation.speckle_size_px, 0, 1 << 30);
  requireRange("validation.speckle_step_px", validation.speckle_step_px, 0, 1e6);
  requireOneOf("validation.median_size", validation.median_size, {0, 3, 5});
  requireRange("validation.min_confidence", validation.min_confidence, 0, 1);

  requireEnum("completion.method", completion.method, CompletionMethod::kPaper);
  requireRange("completion.seed_left_right_px", completion.seed_left_right_px, -1e6, 1e6);
  requireRange("completion.seed_speckle_size_px", completion.seed_speckle_size_px, 0, 1 << 30);
  requireOneOf("completion.segment_scale", completion.segment_scale, {1, 2, 4});
  requireRange("completion.search_radius_px", completion.search_radius_px, 1, 1 << 20);
  requireOneOf("completion.median_size", completion.median_size, {0, 3, 5});
  requireOneOf("completion.refine_radius_px", completion.refine_radius_px, {2, 3});
  requireRange("completion.sigma_space_px", completion.sigma_space_px, 0.1, 100);
  requireRange("completion.sigma_range", completion.sigma_range, 0.1, 1000);
  requireRange("completion.pyramid_levels", completion.pyramid_levels, 1, 16);
}

Options Options::preset(std::string_view name) {
  Options o;
  if (name == "balanced") return o;
  if (name == "fast") {
    o.cost = {MatchingCost::kCensus5x5, 0};
    o.aggregation = {4, 8, 40, 14, PenaltyAdaptation::kSoftIntensity};
    o.validation.left_right_px = 1.0f;
    // A plain census leaves too few seeds to be strict about them.
    o.completion.seed_left_right_px = 1.0f;
    o.completion.seed_speckle_size_px = 50;
    o.completion.fine_segments = false;
    o.completion.weighted_median = false;
    o.completion.plane_refinement = false;
    return o;
  }
  if (name == "quality") {
    o.validation.left_right_px = 0.7f;
    o.validation.speckle_size_px = 100;
    o.completion.refine_radius_px = 3;
    o.second_pass.enabled = true;
    return o;
  }
  if (name == "paper") {
    o.cost = {MatchingCost::kMutualInformation, 0};
    o.aggregation = {8, 10, 100, 10, PenaltyAdaptation::kInverseIntensity};
    o.winner.subpixel = SubpixelMethod::kParabola;
    o.validation.left_right_px = 1.0f;
    o.completion.method = CompletionMethod::kPaper;
    o.align_rows = false;
    return o;
  }
  throw std::invalid_argument("preset is '" + std::string(name) +
                              "'; allowed: fast, balanced, quality, paper");
}

}  // namespace pomona
