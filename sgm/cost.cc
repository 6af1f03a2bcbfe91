#include "sgm/cost.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <span>

#include "core/parallel.h"
#include "sgm/mutual_information.h"

namespace pomona {
namespace {

constexpr int kPriorSteps = 4;  // ramps per pixel of disparity

}  // namespace

int maximumCost(MatchingCost cost) {
  switch (cost) {
    case MatchingCost::kCensus5x5:
      return 24;
    case MatchingCost::kCensus7x7:
      return 48;
    case MatchingCost::kCensus9x7:
      return 62;
    case MatchingCost::kCenterSymmetricCensus9x7:
      return 31;
    case MatchingCost::kMutualInformation:
      return MutualInformation::kMaximumCost;
    case MatchingCost::kBlended:
      return 45;
  }
  return 255;
}

DisparityRange makeRange(int min_disparity, int disparities, const SgmKernels& kernels) {
  return {min_disparity, disparities, vectorsFor(disparities, kernels.vector_bytes), kernels.vector_bytes};
}

void MatchingCostRows::start(Kind kind, const Features& left, int width, int height, int planes,
                             int maximum_cost, const DisparityRange& range, const SgmKernels& kernels,
                             Arena& arena) {
  kind_ = kind;
  left_ = left;
  width_ = width;
  height_ = height;
  planes_ = planes;
  maximum_ = maximum_cost;
  range_ = range;
  kernels_ = &kernels;
  supported_ = has_prior_ = false;

  padding_.resize(range.lanes());
  for (int d = 0; d < range.lanes(); ++d) {
    const int vector = d % range.vectors, lane = d / range.vectors;
    padding_[vector * range.vector_bytes + lane] =
        d < range.disparities ? 0 : static_cast<std::uint8_t>(maximum_cost);
  }

  // The last load of a phase starts at (width - 1 + vectors - 1) / vectors and takes a whole vector.
  phase_stride_ = ((width - 1) / range.vectors + 1 + range.vector_bytes + 63) / 64 * 64;
  plane_stride_ = phase_stride_ * range.vectors;
  row_stride_ = plane_stride_ * planes;
  striped_ = arena.take<std::uint8_t>(static_cast<std::size_t>(row_stride_) * height);
}

void MatchingCostRows::stripeRow(const std::uint8_t* right, int y, int plane) {
  constexpr int kBlock = 64;
  std::uint8_t* const to = striped_ + y * row_stride_ + plane * plane_stride_;
  const int n = range_.vectors, length = static_cast<int>(phase_stride_);
  // Byte m of a phase stands for column c - m * n - phase. Columns right of the image come first, columns
  // left of it last; in between lie blocks whose columns are all inside.
  const int c = width_ - 1 - range_.min_disparity;
  const int first = std::clamp((std::max(0, -range_.min_disparity) + n - 1) / n, 0, length);
  const int blocks = std::max(0, (std::min((c + 1) / n, length) - first) / kBlock),
            last = first + blocks * kBlock;
  kernels_->dealRow(right + c - first * n, n, phase_stride_, blocks, to + first);
  const auto dealClamped = [&](int begin, int end) {
    for (int phase = 0; phase < n; ++phase)
      for (int m = begin; m < end; ++m)
        to[phase * phase_stride_ + m] = right[std::clamp(c - m * n - phase, 0, width_ - 1)];
  };
  dealClamped(0, first);
  dealClamped(last, length);
}

void MatchingCostRows::startCensus(const Features& left, int maximum_cost, const DisparityRange& range,
                                   const SgmKernels& kernels, Arena& arena) {
  const CensusPlanes& codes = *left.census;
  start(Kind::kCensus, left, codes.plane[0].width, codes.plane[0].height, codes.planes, maximum_cost, range,
        kernels, arena);
}

void MatchingCostRows::startBlended(const Features& left, int maximum_cost, const DisparityRange& range,
                                    const SgmKernels& kernels, Arena& arena) {
  start(Kind::kBlended, left, left.gray.width, left.gray.height, kBlendedPlanes, maximum_cost, range, kernels,
        arena);
}

void MatchingCostRows::startTable(const Features& left, std::span<const std::uint8_t, 65536> table,
                                  int maximum_cost, const DisparityRange& range, const SgmKernels& kernels,
                                  Arena& arena) {
  start(Kind::kTable, left, left.gray.width, left.gray.height, 1, maximum_cost, range, kernels, arena);
  table_.resize(table.size());
  std::copy(table.begin(), table.end(), table_.data());
}

void MatchingCostRows::setRight(const Features& right, int threads) {
  ImageView<const std::uint8_t> planes[kMaxCensusPlanes];
  const int codes = kind_ == Kind::kTable ? 0 : right.census->planes;
  for (int p = 0; p < codes; ++p) planes[p] = right.census->plane[p];
  if (kind_ == Kind::kBlended) planes[codes] = right.sobel;
  if (kind_ != Kind::kCensus) planes[planes_ - 1] = right.gray;
  parallelStrips(threads, height_, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int p = 0; p < planes_; ++p) stripeRow(planes[p].row(y), y, p);
  });
}

void MatchingCostRows::prepareSupport(const ColorSteps& steps, int color_step, Arena& arena, int threads) {
  supported_ = color_step > 0;
  if (!supported_) return;
  arms_ = arena.image<std::uint8_t>(width_, height_);
  const Arena::Scope scope(arena);
  const auto left_steps = arena.image<std::uint8_t>(width_ + 2, height_);
  const auto above_steps = arena.image<std::uint8_t>(width_ + 2, height_);
  parallelStrips(threads, height_, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      steps.between(y, y, {.left = left_steps.row(y), .above = above_steps.row(y)});
  });
  parallelStrips(threads, height_, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const std::uint8_t *left = left_steps.row(y) + 1, *above = above_steps.row(y) + 1;
      const std::uint8_t* below = above_steps.row(std::min(y + 1, height_ - 1)) + 1;
      std::uint8_t* arms = arms_.row(y);
      const bool has_above = y > 0, has_below = y + 1 < height_;
      for (int x = 0; x < width_; ++x)
        arms[x] =
            static_cast<std::uint8_t>((left[x] < color_step) | (has_above & (above[x] < color_step)) << 2 |
                                      (has_below & (below[x] < color_step)) << 3);
      arms[0] &= ~1;
      for (int x = 0; x + 1 < width_; ++x) arms[x] |= static_cast<std::uint8_t>((arms[x + 1] & 1) << 1);
    }
  });
}

void MatchingCostRows::makeRamps(int weight, int reach_px) {
  const int lanes = range_.lanes(), n = range_.vectors;
  const std::array<int, 5> wanted = {range_.disparities, n, lanes, weight, reach_px};
  if (ramps_of_ == wanted) return;  // as in the frame before
  ramps_of_ = wanted;
  ramps_.resize(static_cast<std::size_t>(kPriorSteps) * range_.disparities * lanes);
  for (int to = 0; to < kPriorSteps * range_.disparities; ++to)
    for (int d = 0; d < lanes; ++d) {
      // Padded disparities stay the dearest of all.
      const float distance = std::abs(static_cast<float>(d) - static_cast<float>(to) / kPriorSteps);
      const float capped = d < range_.disparities ? std::min(distance, static_cast<float>(reach_px))
                                                  : static_cast<float>(reach_px);
      ramps_[static_cast<std::size_t>(to) * lanes + d % n * range_.vector_bytes + d / n] =
          static_cast<std::uint8_t>(static_cast<float>(weight) * capped + 0.5f);
    }
}

void MatchingCostRows::preparePrior(ImageView<const float> map, int shift_px, int weight, int reach_px,
                                    Arena& arena, int threads) {
  has_prior_ = true;
  maximum_ += weight * reach_px;
  makeRamps(weight, reach_px);
  prior_ = arena.image<std::uint16_t>(width_, height_);
  parallelStrips(threads, height_, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < width_; ++x) {
        const float index = map.at(y, x) - static_cast<float>(range_.min_disparity + shift_px);
        prior_.row(y)[x] = std::isnan(index) ? kNoIndex
                                             : static_cast<std::uint16_t>(std::clamp(
                                                   std::floor(kPriorSteps * index + 0.5f), 0.0f,
                                                   static_cast<float>(kPriorSteps * range_.disparities - 1)));
      }
  });
}

CensusCostRow MatchingCostRows::censusRow(int y, std::uint8_t* cost) const {
  CensusCostRow r{.width = width_,
                  .vectors = range_.vectors,
                  .planes = left_.census->planes,
                  .left = {},
                  .right = stripedRow(y),
                  .padded = range_.disparities < range_.lanes(),
                  .padding = padding_.data(),
                  .cost = cost};
  for (int p = 0; p < r.planes; ++p) r.left[p] = left_.census->plane[p].row(y);
  return r;
}

void MatchingCostRows::row(int y, std::uint8_t* cost) const {
  if (kind_ == Kind::kTable)
    kernels_->tableCost(
        {width_, range_.vectors, left_.gray.row(y), stripedRow(y), table_.data(), padding_.data(), cost});
  else if (kind_ == Kind::kBlended)
    kernels_->blendedCost({censusRow(y, cost), left_.sobel.row(y), left_.gray.row(y)});
  else
    kernels_->censusCost(censusRow(y, cost));
}

CostRowReader::CostRowReader(const MatchingCostRows& cost, Arena& arena) : cost_(&cost) {
  if (!cost.supported_) return;
  for (auto& raw : raw_)
    raw.cost = arena.take<std::uint8_t>(static_cast<std::size_t>(cost.width_) * cost.range_.lanes());
}

const std::uint8_t* CostRowReader::rawRow(int y) {
  auto& raw = raw_[y % 3];
  if (raw.y != y) cost_->row(y, raw.cost);
  raw.y = y;
  return raw.cost;
}

void CostRowReader::row(int y, std::uint8_t* cost) {
  const int vectors = cost_->range_.vectors, width = cost_->width_;
  if (cost_->supported_) {
    const std::uint8_t* here = rawRow(y);
    const std::uint8_t* above = y > 0 ? rawRow(y - 1) : here;
    const std::uint8_t* below = y + 1 < cost_->height_ ? rawRow(y + 1) : here;
    cost_->kernels_->support({width, vectors, above, here, below, cost_->arms_.row(y), cost});
  } else {
    cost_->row(y, cost);
  }
  if (cost_->has_prior_)
    cost_->kernels_->prior({width, vectors, cost_->prior_.row(y), cost_->ramps_.data(), cost, cost});
}

}  // namespace pomona
