// Semi-global aggregation of one row (Hirschmueller 2008, Eq. 13), all paths of a sweep fused.
//
//   L_r(p,d) = C(p,d) + min(L_r(p-r,d), L_r(p-r,d-1) + P1, L_r(p-r,d+1) + P1, m + P2) - m,   m = min_k
//   L_r(p-r,k)
//
// Bytes suffice: the cheapest disparity of p - r continues at no penalty, so min_d L_r <= C_max, every
// L_r <= C_max + P2, and no intermediate exceeds C_max + P1 + P2 <= 255 (checked by Options::validate).
#pragma once

#include "sgm/kernels.h"
#include "sgm/kernels/cost.inl"
#include "sgm/kernels/dispatch.inl"
#include "sgm/kernels/winner.inl"

namespace {

using pomona::AggregateRow;
using simd::U16;
using simd::U8;

constexpr int kMaxVectors = pomona::kMaxDisparities / simd::kBytes;
template <int kVectors>
constexpr int kCapacity = kVectors ? kVectors : kMaxVectors;

/// The recurrence: path costs `previous`, whose smallest value is `minimum`, extended to a pixel with
/// matching cost `cost`. Returns a vector whose smallest lane is the new minimum. Either the previous costs
/// lose their minimum first, or what is chosen from them does: the same result, with an operation less or a
/// shorter way from the minimum on.
template <int kVectors, bool kMinimumIsLate>
POMONA_OP U8 extendPath(const U8* previous, U8 minimum, U8 p1, U8 p2, const U8* cost, U8* next, int vectors) {
  const int n = kVectors ? kVectors : vectors;
  U8 from[kCapacity<kVectors>];
  for (int j = 0; j < n; ++j) from[j] = kMinimumIsLate ? previous[j] : simd::sub(previous[j], minimum);
  // The 255 shifted in at either end never wins the `min` before P1 is added: the other neighbour is a real
  // one.
  const U8 below_first = simd::previousLane(from[n - 1]), above_last = simd::nextLane(from[0]);
  const U8 jump = kMinimumIsLate ? simd::add(minimum, p2) : p2;
  U8 smallest = jump;  // until the loop has its first
  for (int j = 0; j < n; ++j) {
    const U8 below = j > 0 ? from[j - 1] : below_first, above = j < n - 1 ? from[j + 1] : above_last;
    const U8 stepped = simd::add(simd::min(below, above), p1);
    const U8 cheapest = simd::min(simd::min(from[j], stepped), jump);
    next[j] = simd::add(cost[j], kMinimumIsLate ? simd::sub(cheapest, minimum) : cheapest);
    smallest = j == 0 ? next[0] : simd::min(smallest, next[j]);
  }
  return smallest;
}

template <int kVectors>
POMONA_OP void loadPixel(const std::uint8_t* p, U8* v, int vectors) {
  for (int j = 0; j < (kVectors ? kVectors : vectors); ++j) v[j] = simd::load(p + j * simd::kBytes);
}
template <int kVectors>
POMONA_OP void storePixel(std::uint8_t* p, const U8* v, int vectors) {
  for (int j = 0; j < (kVectors ? kVectors : vectors); ++j) simd::store(p + j * simd::kBytes, v[j]);
}

/// Whether an earlier stretch of the row has been done.
template <int kStep>
POMONA_OP bool isResumed(const AggregateRow& r) {
  return kStep > 0 ? r.begin > 0 : r.end < r.width;
}

/// Walks a stretch of the row in steps of kStep and calls emit(x, cost, left, straight, right, horizontal)
/// with the path costs of every pixel, and now and then done(x, count) after the last pixel x of `count`. The
/// paths are updated in place: the one whose predecessor lies behind us is carried in registers.
template <int kVectors, int kStep, bool kDiagonals, bool kCheapCost, typename Emit, typename Done>
POMONA_OP void sweepRow(const AggregateRow& row, Emit&& emit, Done&& done) {
  const AggregateRow r = row;  // stores of vectors may alias everything but locals
  constexpr int kN = kCapacity<kVectors>;
  constexpr int kBehind = kStep > 0 ? 0 : 2, kAhead = 2 - kBehind;
  const int n = kVectors ? kVectors : r.vectors;
  const std::ptrdiff_t pixel = static_cast<std::ptrdiff_t>(n) * simd::kBytes;
  std::uint8_t *behind = r.path[kBehind] + pixel, *straight = r.path[1] + pixel,
               *ahead = r.path[kAhead] + pixel;
  std::uint32_t* minima = r.minima + 4;
  const U8 p1 = simd::broadcast(r.p1);

  const int count = r.end - r.begin;
  std::ptrdiff_t x = kStep > 0 ? r.begin : r.end - 1;
  U8 carried[kN], horizontal[kN], horizontal_minimum = simd::broadcast(0),
                                  carried_minimum = horizontal_minimum;
  for (int j = 0; j < n; ++j)
    carried[j] = horizontal[j] = horizontal_minimum;  // the guard pixel, and a fresh start
  std::uint8_t* const border_minima = r.border + 2 * pixel;
  if (isResumed<kStep>(r)) {
    loadPixel<kVectors>(r.border, carried, n);
    loadPixel<kVectors>(r.border + pixel, horizontal, n);
    carried_minimum = simd::load(border_minima);
    horizontal_minimum = simd::load(border_minima + simd::kBytes);
  }

  for (int i = 0; i < count; ++i, x += kStep) {
    if (i > 0 && i % pomona::kWinnerBlock == 0) done(x - kStep, pomona::kWinnerBlock);
    U8 cost[kN], previous[kN], to_behind[kN], to_straight[kN], to_ahead[kN], to_horizontal[kN];
    if constexpr (kCheapCost)
      censusPixel<kVectors, 3>(r.census, static_cast<int>(x), cost);
    else
      loadPixel<kVectors>(r.cost + x * pixel, cost, n);
    const U8 m3 = extendPath<kVectors, true>(
        horizontal, horizontal_minimum, p1, simd::broadcastQuad(r.p2 + r.step[3][x]), cost, to_horizontal, n);
    const U8 straight_minimum = simd::broadcastQuad(minima + 4 * x + 1);
    loadPixel<kVectors>(straight + x * pixel, previous, n);
    const U8 m1 = extendPath<kVectors, false>(previous, straight_minimum, p1,
                                              simd::broadcastQuad(r.p2 + r.step[1][x]), cost, to_straight, n);
    storePixel<kVectors>(straight + x * pixel, to_straight, n);
    U8 m_behind, m_ahead;
    if constexpr (kDiagonals) {
      m_behind = extendPath<kVectors, false>(
          carried, carried_minimum, p1, simd::broadcastQuad(r.p2 + r.step[kBehind][x]), cost, to_behind, n);
      carried_minimum = simd::broadcastQuad(minima + 4 * x + kBehind);
      loadPixel<kVectors>(behind + x * pixel, carried, n);
      storePixel<kVectors>(behind + x * pixel, to_behind, n);

      const U8 ahead_minimum = simd::broadcastQuad(minima + 4 * (x + kStep) + kAhead);
      loadPixel<kVectors>(ahead + (x + kStep) * pixel, previous, n);
      m_ahead = extendPath<kVectors, false>(previous, ahead_minimum, p1,
                                            simd::broadcastQuad(r.p2 + r.step[kAhead][x]), cost, to_ahead, n);
      storePixel<kVectors>(ahead + x * pixel, to_ahead, n);
    }
    simd::Minima all;
    if constexpr (kDiagonals)
      all = kStep > 0 ? simd::minima(m_behind, m1, m_ahead, m3) : simd::minima(m_ahead, m1, m_behind, m3);
    else
      all = simd::minima(m1, m3);
    simd::storeMinima(minima + 4 * x, all);
    horizontal_minimum = simd::lastMinimum(all);
    for (int j = 0; j < n; ++j) horizontal[j] = to_horizontal[j];
    emit(x, cost, to_behind, to_straight, to_ahead, to_horizontal);
  }
  if (r.border) {
    storePixel<kVectors>(r.border, carried, n);
    storePixel<kVectors>(r.border + pixel, horizontal, n);
    simd::store(border_minima, carried_minimum);
    simd::store(border_minima + simd::kBytes, horizontal_minimum);
  }
  done(x - kStep, (count - 1) % pomona::kWinnerBlock + 1);
}

/// Asks for the sums that the walk comes to a page later, where vector j of a pixel begins a line of the
/// cache: the hardware fetches ahead of a walk, but not across pages.
template <int kStep>
POMONA_OP void fetchSums(const std::uint8_t* sums, int j) {
  constexpr int kPage = 4096, kLine = 64;
  if (j * simd::kBytes % kLine == 0) __builtin_prefetch(sums + kStep * kPage);
}

/// Sum of the sweep's path costs for vector j, modulo 256.
template <bool kDiagonals>
POMONA_OP U8 byteSum(U8 behind, U8 straight, U8 ahead, U8 horizontal) {
  const U8 cross = simd::add(straight, horizontal);
  return kDiagonals ? simd::add(cross, simd::add(behind, ahead)) : cross;
}
template <bool kDiagonals>
POMONA_OP void wordSum(U8 behind, U8 straight, U8 ahead, U8 horizontal, U16& low, U16& high) {
  low = simd::addScaledLow<1>(straight, horizontal);
  high = simd::addScaledHigh<1>(straight, horizontal);
  if constexpr (kDiagonals) {
    low = simd::add16(low, simd::addScaledLow<1>(behind, ahead));
    high = simd::add16(high, simd::addScaledHigh<1>(behind, ahead));
  }
}

template <int kVectors, bool kDiagonals, bool kWide, bool kCheapCost>
void firstPass(const AggregateRow& r) {
  const int n = kVectors ? kVectors : r.vectors;
  sweepRow<kVectors, 1, kDiagonals, kCheapCost>(
      r,
      [&](std::ptrdiff_t x, const U8*, const U8* b, const U8* s, const U8* a, const U8* h) {
        for (int j = 0; j < n; ++j) {
          const std::ptrdiff_t at = (x * n + j) * simd::kBytes;
          if constexpr (kWide) {
            U16 low, high;
            wordSum<kDiagonals>(b[j], s[j], a[j], h[j], low, high);
            auto* sums = static_cast<std::uint16_t*>(r.sums) + at;
            simd::store16(sums, low);
            simd::store16(sums + simd::kBytes / 2, high);
          } else {
            std::uint8_t* const sums = static_cast<std::uint8_t*>(r.sums) + at;
            fetchSums<1>(sums, j);
            simd::store(sums, byteSum<kDiagonals>(b[j], s[j], a[j], h[j]));
          }
        }
      },
      [](std::ptrdiff_t, int) {});
}

/// Completes the sums. In bytes: each path exceeds its matching cost C by at most P2 (it is C plus a
/// penalty), so a sweep of four paths satisfies 0 <= sum - 4 C <= 4 P2 <= 252 and is known exactly from its
/// value modulo 256. With cheap costs the sum itself is below 256, and so is that of two paths.
template <int kVectors, bool kDiagonals, bool kWide, bool kCheapCost, int kLabelBits>
void lastPass(const AggregateRow& r, const WinnerRow& w) {
  const int n = kVectors ? kVectors : r.vectors;
  Winner<kVectors, kLabelBits> winner(w, n, r.width, isResumed<-1>(r));
  sweepRow<kVectors, -1, kDiagonals, kCheapCost>(
      r,
      [&](std::ptrdiff_t x, const U8* c, const U8* b, const U8* s, const U8* a, const U8* h) {
        U16 sums[2 * kCapacity<kVectors>];
        for (int j = 0; j < n; ++j) {
          const std::ptrdiff_t at = (x * n + j) * simd::kBytes;
          const auto* const bytes = static_cast<const std::uint8_t*>(r.sums) + at;
          if constexpr (!kWide) fetchSums<-1>(bytes, j);
          if constexpr (kWide) {
            wordSum<kDiagonals>(b[j], s[j], a[j], h[j], sums[2 * j], sums[2 * j + 1]);
            const auto* first = static_cast<const std::uint16_t*>(r.sums) + at;
            sums[2 * j] = simd::add16(sums[2 * j], simd::load16(first));
            sums[2 * j + 1] = simd::add16(sums[2 * j + 1], simd::load16(first + simd::kBytes / 2));
          } else if constexpr (kCheapCost || !kDiagonals) {
            const U8 first = simd::load(bytes);
            const U8 last = byteSum<kDiagonals>(b[j], s[j], a[j], h[j]);
            sums[2 * j] = simd::addScaledLow<1>(first, last);
            sums[2 * j + 1] = simd::addScaledHigh<1>(first, last);
          } else {
            const U8 twice = simd::add(c[j], c[j]), base = simd::add(twice, twice);
            const U8 first = simd::sub(simd::load(bytes), base);
            const U8 last = simd::sub(byteSum<kDiagonals>(b[j], s[j], a[j], h[j]), base);
            sums[2 * j] = simd::add16(simd::addScaledLow<8>(last, c[j]), simd::widenLow(first));
            sums[2 * j + 1] = simd::add16(simd::addScaledHigh<8>(last, c[j]), simd::widenHigh(first));
          }
        }
        winner.put(x, sums);
      },
      [&](std::ptrdiff_t x, int count) { winner.chooseWinners(static_cast<int>(x) + count - 1, count); });
  r.begin == 0 ? winner.finish() : winner.suspend();
}

/// Calls f(number of vectors, whether there are diagonals, wide sums, cheap costs), as constants. Cheap costs
/// that come with wide sums are stored first, like others.
template <typename F>
POMONA_OP void withShape(const AggregateRow& r, F f) {
  constexpr Constant<1> yes{};
  constexpr Constant<0> no{};
  withVectors(r.vectors, [&](auto v) {
    if (r.cost == nullptr) return r.diagonals ? f(v, yes, no, yes) : f(v, no, no, yes);
    if (r.diagonals) return r.wide_sums ? f(v, yes, yes, no) : f(v, yes, no, no);
    r.wide_sums ? f(v, no, yes, no) : f(v, no, no, no);
  });
}

void aggregateFirst(const AggregateRow& r) {
  withShape(r, [&](auto v, auto diagonals, auto wide, auto cheap) {
    firstPass<v(), diagonals(), wide(), cheap()>(r);
  });
}

template <int kLabelBits>
void aggregateLastWith(const AggregateRow& r, const WinnerRow& w) {
  withShape(r, [&](auto v, auto diagonals, auto wide, auto cheap) {
    lastPass<v(), diagonals(), wide(), cheap(), wide() ? 0 : kLabelBits>(r, w);
  });
}

void aggregateLast(const AggregateRow& r, const WinnerRow& w) {
  switch (w.label_bits) {
    case 6:
      return aggregateLastWith<6>(r, w);
    case 7:
      return aggregateLastWith<7>(r, w);
    default:
      return aggregateLastWith<0>(r, w);
  }
}

}  // namespace
