// The matcher's inner loops, one table per instruction set.
//
// STRIPED ORDER. The D disparities of a pixel occupy `vectors` byte vectors of kBytes lanes; disparity index
// d = vectors * lane + vector. A step of one disparity is then a step of one vector, and only the outermost
// vectors need a lane shift. D is padded to a multiple of kBytes. Padded disparities carry the largest
// possible matching cost: by induction their path costs never fall below that of disparity D - 1, so they
// change nothing.
//
// 16-bit sums use two word vectors per byte vector (see core/simd/scalar.h); wordPosition() says where d
// stands.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pomona {

enum class Isa;  // core/cpu.h; kernels see no standard library

constexpr int kMaxDisparities = 1024;
constexpr std::uint16_t kNoIndex = 0xFFFF;
constexpr int kWinnerBlock = 32;  ///< winners are chosen for so many pixels at a time
constexpr int kMaxCensusPlanes = 8;
constexpr int kBlendedPlanes = 6;  // of the right view: census, Sobel, gray

/// Right-image bytes of one row, reversed and dealt out to `vectors` phases: with t = width - 1 - x + d, byte
/// t / vectors of phase t % vectors belongs to column x - min_disparity - d, clamped to the image.
struct StripedRow {
  const std::uint8_t* data;
  std::ptrdiff_t phase_stride;
  std::ptrdiff_t plane_stride;  ///< from one census plane to the next
};

struct CensusCostRow {
  int width, vectors, planes;                  ///< planes: bytes per census code, 3, 4, 6 or 8
  const std::uint8_t* left[kMaxCensusPlanes];  ///< one byte per pixel and plane
  StripedRow right;
  bool padded;                  ///< whether there are padded lanes
  const std::uint8_t* padding;  ///< vectors * kBytes: the maximum cost in padded lanes, 0 elsewhere
  std::uint8_t* cost;           ///< out: width * vectors * kBytes
};

/// Census beside two truncated absolute differences:
///   C = hamming + (min(20, |S_left - S_right|) + min(40, |I_left - I_right|) / 4) / 2      (quotients
///   rounded up)
/// with S the clamped horizontal Sobel response (see sobelRow) and I the gray value: 0 .. 30 + 15.
struct BlendedCostRow {
  CensusCostRow census;       ///< 4 planes; its `right` goes on with a Sobel plane and a gray plane
  const std::uint8_t* sobel;  ///< left
  const std::uint8_t* gray;   ///< left
};

/// Costs averaged over a pixel (weight 1/4) and its four neighbours (3/16 each); a neighbour that does not
/// belong is replaced by the pixel itself. Rounded up at each of the five halvings.
struct SupportRow {
  int width, vectors;
  const std::uint8_t *above, *here,
      *below;                ///< cost rows; above and below may be anything where no pixel uses them
  const std::uint8_t* arms;  ///< per pixel: bit 0 left, 1 right, 2 above, 3 below belongs
  std::uint8_t* cost;
};

/// Adds to every cost the ramp of its pixel.
struct PriorRow {
  int width, vectors;
  const std::uint16_t* index;  ///< ramp of each pixel, or kNoIndex
  const std::uint8_t* ramps;   ///< each vectors * kBytes bytes in striped order
  const std::uint8_t* in;
  std::uint8_t* out;  ///< may be `in`
};

struct TableCostRow {
  int width, vectors;
  const std::uint8_t* left;   ///< one byte per pixel
  StripedRow right;           ///< one plane
  const std::uint8_t* table;  ///< 256 x 256, row = left byte
  const std::uint8_t* padding;
  std::uint8_t* cost;
};

/// One row of one sweep, or a stretch of it. A sweep carries three paths from row to row (from the left,
/// straight, from the right) and starts a horizontal one in every row. Arrays with a guard pixel hold
/// width + 2 pixels, pixel x at x + 1.
struct AggregateRow {
  int width, vectors;
  int begin, end;        ///< the columns to be done now; stretches follow one another in the row's direction
  std::uint8_t* border;  ///< aggregateBorderBytes() that carry the paths from stretch to stretch; null if the
                         ///< row is done at once
  bool diagonals;        ///< false: only the straight and the horizontal path
  bool wide_sums;        ///< 16-bit partial sums instead of the 8-bit ones
  const std::uint8_t* cost;  ///< width * vectors * kBytes; or null:
  CensusCostRow census;      ///< the costs are those of three planes, and computed on the way; the sum of
                             ///< the sweep's path costs is below 256
  std::uint8_t* path[3];  ///< in: costs of the previous row, out: of this one; guard pixels are zero. Without
                          ///< diagonals only path[1] is used
  std::uint32_t* minima;  ///< 4 quads per pixel (left, straight, right, horizontal; without diagonals
                          ///< the second and the fourth count); guard pixels are zero
  const std::uint8_t*
      step[4];  ///< colour step into pixel x, in the order of `minima`; anything at a path's start
  const std::uint32_t* p2;  ///< 256 quads: the penalty for a colour step
  std::uint8_t p1;
  void* sums;  ///< first pass: out, second pass: in. width * vectors * kBytes bytes or words
};

struct WinnerRow {
  int disparities, min_disparity;
  const std::uint16_t* position;  ///< wordPosition of every disparity index; the ends repeat, from -1 on to
                                  ///< index_mask + 1
  int index_mask;                 ///< winnerIndexMask(disparities)
  const std::uint16_t* labels;    ///< of every word position the disparity index, without its shared_bits
                                  ///< lowest bits; kNoIndex for padding
  int label_bits, shared_bits;    ///< labelBits(), sharedBits()
  const std::uint16_t* near;      ///< if label_bits > 0: per index, 0xFFFF at the positions at most one away
  bool padded;                    ///< whether there are padded disparities
  const std::uint16_t* padding;   ///< 0xFFFF at padded word positions, 0 elsewhere
  std::uint16_t* index;        ///< out, per pixel: the disparity index of the lowest sum (the lowest if tied)
  std::uint16_t* best;         ///< out: that sum
  std::uint16_t* below;        ///< out: the sum one disparity below (the pixel's own at index 0)
  std::uint16_t* above;        ///< out: the sum one disparity above (the pixel's own at the last index)
  std::uint16_t* second;       ///< out: the lowest sum more than one disparity away; 0xFFFF if there is none
  std::uint16_t* right_index;  ///< out, per right pixel, kNoIndex if none; must come in as kNoIndex
  std::uint16_t* right_best;   ///< out: its sum; must come in as kNoIndex
  std::uint16_t*
      right_below;  ///< out: the sum one disparity below, seen from the same right pixel; 0xFFFF, like
  std::uint16_t* right_above;   ///< right_above, unless both lie in the image and the range
  std::uint16_t* recent;        ///< scratch: the sums of the last recent_mask + 1 pixels
  int recent_mask;              ///< a power of two less one; at least disparities + 2 + kWinnerBlock pixels
  std::uint16_t* right_border;  ///< 4 * vectors * kBytes words that carry the right view's candidates from
                                ///< stretch to stretch; null if the row is done at once
};

/// How clearly the winners of a row have won.
struct ScoreRow {
  int width;
  const std::uint16_t *best, *below, *above, *second;
  std::uint16_t* margin;     ///< out: second - best, or 0
  std::uint16_t* curvature;  ///< out: below + above - 2 best, or 0
};

/// How far the minimum lies from a whole disparity, towards its better neighbour: 1/2 - a r - b r^2 - c r^3,
/// if that neighbour is r times as much worse than it as the other.
struct SubpixelCurve {
  float a, b, c;
};

/// Sub-pixel disparities from what winner-take-all left of one row of one view.
struct RefineRow {
  int width, disparities, min_disparity;
  const std::uint16_t *index, *best, *below, *above;
  float* disparity;     ///< out; NaN where index is kNoIndex
  SubpixelCurve curve;  ///< for SubpixelMethod::kFitted
};

/// Two neighbouring rows, and the steps between their pixels: the largest difference of a channel. What it is
/// at the ends of a row, where there is no neighbour, is of no meaning.
struct ColorStepRows {
  const std::uint8_t *row_above, *row;
  const std::uint8_t* ahead;  ///< the row to be asked for next
  int channels, width;        ///< channels: 1 or 3, interleaved
  bool left_of_above;         ///< left[x]: of row_above, not of `row`
  std::uint8_t *left, *above;
  std::uint8_t *above_left, *above_right;  ///< both or none may be null
};

struct SgmKernels {
  int vector_bytes;  ///< kBytes
  /// gray[x] = (29 B + 150 G + 77 R + 128) / 256.
  void (*gray8)(const std::uint8_t* bgr, int width, std::uint8_t* gray);
  void (*gray16)(const std::uint16_t* bgr, int width, std::uint16_t* gray);
  /// Bit k of out[x] = (a[k][x] < b[k][x]), for 8 pairs of rows.
  void (*census8)(const std::uint8_t* const a[8], const std::uint8_t* const b[8], int width,
                  std::uint8_t* out);
  void (*census16)(const std::uint16_t* const a[8], const std::uint16_t* const b[8], int width,
                   std::uint8_t* out);
  /// out[x] = clamp(128 + S / 4, 0, 255), S the 3x3 horizontal Sobel sum over three rows readable from -1 to
  /// width.
  void (*sobel)(const std::uint8_t* const rows[3], int width, std::uint8_t* out);
  void (*colorSteps)(const ColorStepRows&);
  /// out[phase * phase_stride + m] = right[-(m * phases + phase)] for m < 64 * blocks, phase < phases.
  void (*dealRow)(const std::uint8_t* right, int phases, std::ptrdiff_t phase_stride, int blocks,
                  std::uint8_t* out);
  void (*censusCost)(const CensusCostRow&);
  void (*tableCost)(const TableCostRow&);
  void (*blendedCost)(const BlendedCostRow&);
  void (*support)(const SupportRow&);
  void (*prior)(const PriorRow&);
  /// Left to right; leaves the partial sums of its paths.
  void (*aggregateFirst)(const AggregateRow&);
  void (*score)(const ScoreRow&);
  /// One per SubpixelMethod, in its order.
  void (*refine[4])(const RefineRow&);
  /// Right to left; completes the sums and picks the winners of both views, which are valid once the row is
  /// done.
  void (*aggregateLast)(const AggregateRow&, const WinnerRow&);
};

const SgmKernels& sgmKernels(Isa isa);

constexpr int vectorsFor(int disparities, int vector_bytes) {
  return (disparities + vector_bytes - 1) / vector_bytes;
}

/// Two pixels' path costs, and their minima.
constexpr int aggregateBorderBytes(int vectors, int vector_bytes) {
  return 2 * (vectors + 1) * vector_bytes;
}

/// A mask that lets every disparity index, and every packed one, through.
constexpr int winnerIndexMask(int disparities) {
  int mask = 127;
  while (mask < disparities - 1) mask = 2 * mask + 1;
  return mask;
}

/// How many bits of a word the disparity index may have beside sums of up to `largest_sum`: 6, 7, or 0 if
/// fewer are left. The word 0xFFFF stays free.
constexpr int labelBits(int lanes, int largest_sum) {
  for (int bits = lanes <= 64 ? 6 : 7; bits >= 6; --bits)
    if (largest_sum < 0xFFFF >> bits) return lanes <= 256 ? bits : 0;
  return 0;
}

/// How many of the lowest bits of an index its label leaves out: disparities that differ in these share one.
constexpr int sharedBits(int lanes, int label_bits) {
  int bits = 0;
  while (label_bits > 0 && lanes > 1 << (label_bits + bits)) ++bits;
  return bits;
}

/// Where the 16-bit sum of disparity index d stands among those of its pixel.
constexpr int wordPosition(int d, int vectors, int vector_bytes) {
  const int vector = d % vectors, lane = d / vectors, block = lane / 16, in_block = lane % 16;
  return (2 * vector + in_block / 8) * (vector_bytes / 2) + block * 8 + in_block % 8;
}

}  // namespace pomona
