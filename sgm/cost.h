// Matching cost of a rectified pair, produced row by row: the cost volume is never stored.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/arena.h"
#include "core/image.h"
#include "sgm/census.h"
#include "sgm/color_steps.h"
#include "sgm/kernels.h"

namespace pomona {

/// The searched disparities and how the kernels lay them out.
struct DisparityRange {
  int min_disparity = 0;
  int disparities = 64;
  int vectors = 4;  ///< byte vectors per pixel
  int vector_bytes = 16;

  int lanes() const { return vectors * vector_bytes; }
};
DisparityRange makeRange(int min_disparity, int disparities, const SgmKernels& kernels);

/// Features of both views, laid out for the kernels. cost(p, d) compares left(x, y) with right(x - d, y);
/// columns beyond the right image are those of its border. A pair begins with one of the start functions,
/// setRight() follows, and then what else there is. What is kept lies in the scope of `arena` that was
/// current at the start; the left features are borrowed and must outlive the matching, the right ones need
/// not.
class MatchingCostRows {
 public:
  struct Features {
    const CensusPlanes* census = nullptr;
    ImageView<const std::uint8_t> sobel, gray;
  };
  /// Hamming distance of the codes, 0 .. number of bits.
  void startCensus(const Features& left, int maximum_cost, const DisparityRange& range,
                   const SgmKernels& kernels, Arena& arena);
  /// See BlendedCostRow; needs every feature.
  void startBlended(const Features& left, int maximum_cost, const DisparityRange& range,
                    const SgmKernels& kernels, Arena& arena);
  /// table[256 * left + right] is the cost of a pair of gray values, 0 .. maximum_cost.
  void startTable(const Features& left, std::span<const std::uint8_t, 65536> table, int maximum_cost,
                  const DisparityRange& range, const SgmKernels& kernels, Arena& arena);
  /// The same features as of the left view.
  void setRight(const Features& right, int threads);
  /// Afterwards CostRowReader averages over neighbours whose colour step is below `color_step`; 0: over none.
  void prepareSupport(const ColorSteps& steps, int color_step, Arena& arena, int threads);
  /// Afterwards CostRowReader adds weight * min(|d + shift_px - map|, reach_px); a NaN adds nothing. The map
  /// is not looked at again.
  void preparePrior(ImageView<const float> map, int shift_px, int weight, int reach_px, Arena& arena,
                    int threads);

  /// Whether costs are so cheap that whoever needs them computes them himself, from censusRow().
  bool areCheap() const { return kind_ == Kind::kCensus && planes_ == 3 && !supported_ && !has_prior_; }
  /// Where the costs of row y come from; to be stored at `cost`. Only for costs that begin with a census.
  CensusCostRow censusRow(int y, std::uint8_t* cost) const;

  int width() const { return width_; }
  int height() const { return height_; }
  int maximum() const { return maximum_; }  ///< no cost is larger
  const DisparityRange& range() const { return range_; }

 private:
  friend class CostRowReader;
  enum class Kind { kCensus, kBlended, kTable };

  void start(Kind kind, const Features& left, int width, int height, int planes, int maximum_cost,
             const DisparityRange& range, const SgmKernels& kernels, Arena& arena);
  void stripeRow(const std::uint8_t* right, int y, int plane);
  void makeRamps(int weight, int reach_px);
  StripedRow stripedRow(int y) const { return {striped_ + y * row_stride_, phase_stride_, plane_stride_}; }
  void row(int y, std::uint8_t* cost) const;

  Kind kind_ = Kind::kCensus;
  int width_ = 0, height_ = 0, planes_ = 0, maximum_ = 0;
  DisparityRange range_;
  const SgmKernels* kernels_ = nullptr;
  Features left_;
  Buffer<std::uint8_t> table_;
  Buffer<std::uint8_t> padding_;
  std::uint8_t* striped_ = nullptr;  // every row of the right view, every plane, every phase
  std::ptrdiff_t phase_stride_ = 0, plane_stride_ = 0, row_stride_ = 0;
  bool supported_ = false;
  ImageView<std::uint8_t> arms_;  // see SupportRow
  bool has_prior_ = false;
  ImageView<std::uint16_t> prior_;  // see PriorRow
  Buffer<std::uint8_t> ramps_;
  std::array<int, 5> ramps_of_{};  // what they were made for: disparities, vectors, lanes, weight, reach
};

/// Makes cost rows for one thread; keeps what neighbouring rows share.
class CostRowReader {
 public:
  CostRowReader() = default;
  /// Takes memory from the current scope of `arena`.
  CostRowReader(const MatchingCostRows& cost, Arena& arena);

  /// Writes the costs of row y in striped order: width * range().lanes() bytes, on a 64-byte boundary.
  /// Cheapest for rows in sequence.
  void row(int y, std::uint8_t* cost);

 private:
  const std::uint8_t* rawRow(int y);

  const MatchingCostRows* cost_ = nullptr;
  struct {
    int y = -1;
    std::uint8_t* cost = nullptr;
  } raw_[3];  // of costs with support
};

}  // namespace pomona
