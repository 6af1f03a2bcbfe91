// Matching costs of one row, in striped order.
#pragma once

#include "sgm/kernels.h"
#include "sgm/kernels/dispatch.inl"

namespace {

using pomona::BlendedCostRow;
using pomona::CensusCostRow;
using pomona::PriorRow;
using pomona::StripedRow;
using pomona::SupportRow;
using pomona::TableCostRow;

/// The bytes of vector `vector` of pixel x: columns x - min_disparity - (vectors * lane + vector).
POMONA_OP const std::uint8_t* rightLanes(const StripedRow& right, int width, int vectors, int x, int vector) {
  const unsigned t = static_cast<unsigned>(width - 1 - x + vector), n = static_cast<unsigned>(vectors);
  return right.data + (t % n) * right.phase_stride + t / n;
}

/// out[phase * phase_stride + m] = right[-(m * phases + phase)] for m < 64 * blocks. GCC vectorises the
/// loops.
template <int kPhases>
void dealRowTo(const std::uint8_t* right, int phases, std::ptrdiff_t phase_stride, int blocks,
               std::uint8_t* __restrict out) {
  constexpr int kBlock = 64;
  [[maybe_unused]] const int n = kPhases ? kPhases : phases;
  if constexpr (kPhases == 1) {  // nothing to deal out
    for (int m = 0; m < kBlock * blocks; ++m) out[m] = right[-m];
  } else {
    for (int b = 0; b < blocks; ++b, right -= n * kBlock, out += kBlock) {
      std::uint8_t reversed[(kPhases ? kPhases : pomona::kMaxDisparities / simd::kBytes) * kBlock];
      for (int i = 0; i < n * kBlock; ++i) reversed[i] = right[-i];
      for (int phase = 0; phase < n; ++phase)
        for (int m = 0; m < kBlock; ++m) out[phase * phase_stride + m] = reversed[m * n + phase];
    }
  }
}

void dealRow(const std::uint8_t* right, int phases, std::ptrdiff_t phase_stride, int blocks,
             std::uint8_t* out) {
  withVectors(phases, [&](auto n) { dealRowTo<n()>(right, phases, phase_stride, blocks, out); });
}

/// Hamming distance of the census codes at vector `right` of the right view, 0 .. 8 * planes.
template <int kPlanes>
POMONA_OP simd::U8 hamming(const simd::U8* left, const std::uint8_t* right, std::ptrdiff_t plane_stride) {
  simd::U8 sum = simd::popcount(simd::bitXor(simd::loadUnaligned(right), left[0]));
  for (int p = 1; p < kPlanes; ++p) {
    right += plane_stride;
    sum = simd::add(sum, simd::popcount(simd::bitXor(simd::loadUnaligned(right), left[p])));
  }
  return sum;
}

/// The costs of pixel x.
template <int kVectors, int kPlanes>
POMONA_OP void censusPixel(const CensusCostRow& r, int x, simd::U8* cost) {
  const int vectors = kVectors ? kVectors : r.vectors;
  simd::U8 left[kPlanes];
  for (int p = 0; p < kPlanes; ++p) left[p] = simd::broadcast(r.left[p][x]);
  for (int j = 0; j < vectors; ++j) {
    const std::uint8_t* right = rightLanes(r.right, r.width, vectors, x, j);
    cost[j] = hamming<kPlanes>(left, right, r.right.plane_stride);
    if (r.padded) cost[j] = simd::max(simd::load(r.padding + j * simd::kBytes), cost[j]);
  }
}

template <int kVectors, int kPlanes>
void censusCostOf(const CensusCostRow& row) {
  const CensusCostRow r = row;  // stores of vectors may alias everything but locals
  const int vectors = kVectors ? kVectors : r.vectors;
  std::uint8_t* out = r.cost;
  for (int x = 0; x < r.width; ++x) {
    simd::U8 cost[kVectors ? kVectors : pomona::kMaxDisparities / simd::kBytes];
    censusPixel<kVectors, kPlanes>(r, x, cost);
    for (int j = 0; j < vectors; ++j, out += simd::kBytes) simd::store(out, cost[j]);
  }
}

POMONA_OP simd::U8 truncatedDifference(simd::U8 a, simd::U8 b, simd::U8 limit) {
  return simd::min(simd::sub(simd::max(a, b), simd::min(a, b)), limit);
}

template <int kVectors>
void blendedCostOf(const BlendedCostRow& row) {
  const BlendedCostRow b = row;
  const CensusCostRow& r = b.census;
  const int vectors = kVectors ? kVectors : r.vectors;
  const std::ptrdiff_t plane = r.right.plane_stride;
  const simd::U8 zero = simd::broadcast(0), sobel_limit = simd::broadcast(20),
                 gray_limit = simd::broadcast(40);
  std::uint8_t* out = r.cost;
  for (int x = 0; x < r.width; ++x) {
    simd::U8 left[4];
    for (int p = 0; p < 4; ++p) left[p] = simd::broadcast(r.left[p][x]);
    const simd::U8 sobel = simd::broadcast(b.sobel[x]), gray = simd::broadcast(b.gray[x]);
    for (int j = 0; j < vectors; ++j, out += simd::kBytes) {
      const std::uint8_t* right = rightLanes(r.right, r.width, vectors, x, j);
      const simd::U8 s = truncatedDifference(simd::loadUnaligned(right + 4 * plane), sobel, sobel_limit);
      const simd::U8 g = truncatedDifference(simd::loadUnaligned(right + 5 * plane), gray, gray_limit);
      const simd::U8 differences = simd::average(s, simd::average(simd::average(g, zero), zero));
      simd::U8 cost = simd::add(hamming<4>(left, right, plane), differences);
      if (r.padded) cost = simd::max(simd::load(r.padding + j * simd::kBytes), cost);
      simd::store(out, cost);
    }
  }
}

void blendedCost(const BlendedCostRow& r) {
  withVectors(r.census.vectors, [&](auto v) { blendedCostOf<v()>(r); });
}

template <int kVectors>
void supportOf(const SupportRow& row) {
  const SupportRow r = row;
  const int vectors = kVectors ? kVectors : r.vectors;
  const std::ptrdiff_t pixel = static_cast<std::ptrdiff_t>(vectors) * simd::kBytes;
  for (int x = 0; x < r.width; ++x) {
    const std::ptrdiff_t at = x * pixel;
    const std::uint8_t* here = r.here + at;
    const std::uint8_t* left = r.arms[x] & 1 ? here - pixel : here;
    const std::uint8_t* right = r.arms[x] & 2 ? here + pixel : here;
    const std::uint8_t* above = r.arms[x] & 4 ? r.above + at : here;
    const std::uint8_t* below = r.arms[x] & 8 ? r.below + at : here;
    for (int j = 0; j < vectors; ++j) {
      const int k = j * simd::kBytes;
      const simd::U8 horizontal = simd::average(simd::load(left + k), simd::load(right + k));
      const simd::U8 vertical = simd::average(simd::load(above + k), simd::load(below + k));
      const simd::U8 neighbours = simd::average(horizontal, vertical);
      simd::store(r.cost + at + k,
                  simd::average(neighbours, simd::average(neighbours, simd::load(here + k))));
    }
  }
}

void support(const SupportRow& r) {
  withVectors(r.vectors, [&](auto v) { supportOf<v()>(r); });
}

void censusCost(const CensusCostRow& r) {
  withVectors(r.vectors, [&](auto v) {
    switch (r.planes) {
      case 3:
        return censusCostOf<v(), 3>(r);
      case 4:
        return censusCostOf<v(), 4>(r);
      case 6:
        return censusCostOf<v(), 6>(r);
      default:
        return censusCostOf<v(), 8>(r);
    }
  });
}

void prior(const PriorRow& r) {
  const std::ptrdiff_t pixel = static_cast<std::ptrdiff_t>(r.vectors) * simd::kBytes;
  for (std::ptrdiff_t x = 0; x < r.width; ++x) {
    const bool drawn = r.index[x] != pomona::kNoIndex;
    const std::uint8_t* ramp = r.ramps + (drawn ? r.index[x] : 0) * pixel;
    for (std::ptrdiff_t k = 0; k < pixel; k += simd::kBytes) {
      const simd::U8 cost = simd::load(r.in + x * pixel + k);
      simd::store(r.out + x * pixel + k, drawn ? simd::add(cost, simd::load(ramp + k)) : cost);
    }
  }
}

/// Cost looked up from the pair of bytes (mutual information).
void tableCost(const TableCostRow& r) {
  std::uint8_t* out = r.cost;
  for (int x = 0; x < r.width; ++x) {
    const std::uint8_t* row = r.table + 256 * r.left[x];
    for (int j = 0; j < r.vectors; ++j, out += simd::kBytes) {
      const std::uint8_t* right = rightLanes(r.right, r.width, r.vectors, x, j);
      const std::uint8_t* padding = r.padding + j * simd::kBytes;
      for (int i = 0; i < simd::kBytes; ++i) out[i] = row[right[i]] > padding[i] ? row[right[i]] : padding[i];
    }
  }
}

}  // namespace
