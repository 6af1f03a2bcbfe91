// Matching costs of one row, in striped order.
#pragma once

#include "sgm/kernels.h"
#include "sgm/kernels/dispatch.inl"

namespace {

using pomona::CensusCostRow;
using pomona::StripedRow;
using pomona::TableCostRow;

/// The bytes of vector `vector` of pixel x: columns x - min_disparity - (vectors * lane + vector).
POMONA_OP const std::uint8_t* rightLanes(const StripedRow& right, int width, int vectors, int x, int vector) {
  const unsigned t = static_cast<unsigned>(width - 1 - x + vector), n = static_cast<unsigned>(vectors);
  return right.data + (t % n) * right.phase_stride + t / n;
}

/// Hamming distance of the census codes, 0 .. 8 * planes.
template <int kVectors, int kPlanes>
void censusCostOf(const CensusCostRow& r) {
  const int vectors = kVectors ? kVectors : r.vectors;
  std::uint8_t* out = r.cost;
  for (int x = 0; x < r.width; ++x) {
    simd::U8 left[kPlanes];
    for (int p = 0; p < kPlanes; ++p) left[p] = simd::broadcast(r.left[p][x]);
    for (int j = 0; j < vectors; ++j, out += simd::kBytes) {
      const std::uint8_t* right = rightLanes(r.right, r.width, vectors, x, j);
      simd::U8 distance = simd::load(r.padding + j * simd::kBytes);
      simd::U8 sum = simd::popcount(simd::bitXor(simd::loadUnaligned(right), left[0]));
      for (int p = 1; p < kPlanes; ++p) {
        right += r.right.plane_stride;
        sum = simd::add(sum, simd::popcount(simd::bitXor(simd::loadUnaligned(right), left[p])));
      }
      simd::store(out, simd::max(distance, sum));
    }
  }
}

void censusCost(const CensusCostRow& r) {
  withVectors(r.vectors, [&](auto v) {
    switch (r.planes) {
      case 3:
        return censusCostOf<decltype(v)::value, 3>(r);
      case 4:
        return censusCostOf<decltype(v)::value, 4>(r);
      case 6:
        return censusCostOf<decltype(v)::value, 6>(r);
      default:
        return censusCostOf<decltype(v)::value, 8>(r);
    }
  });
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
