// Regions of similar colour: graph-based segmentation of an image.
//
// P. F. Felzenszwalb and D. P. Huttenlocher, "Efficient graph-based image segmentation", IJCV 59(2), 2004.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/arena.h"
#include "core/image.h"
#include "pyramid/kernels.h"

namespace pomona {

/// The pairs of 8-neighbours of an image, sorted by weight: the largest absolute difference of their
/// channels, 0..255. Pairs of equal weight keep the order of a walk through the image, row by row; in a row
/// first all pairs with the neighbour to the right, then below left, below, below right; in each of these
/// left to right.
class SortedEdges {
 public:
  /// Linear in the number of pixels, at most 2^30 of them. The edges lie in the current scope of `arena`.
  void build(GuideView image, const PyramidKernels& kernels, Arena& arena, int threads);

  static constexpr int kWeights = 256;
  static constexpr int kDirections = 4;

  int width() const { return width_; }
  int height() const { return height_; }
  /// Each edge is kDirections * (its upper or left pixel's index) + direction; see otherEnd().
  std::span<const std::uint32_t> ofWeight(int weight) const {
    const std::size_t w = static_cast<std::size_t>(weight);
    return {edges_ + begin_[w], edges_ + begin_[w + 1]};
  }
  static int firstEnd(std::uint32_t edge) { return static_cast<int>(edge / kDirections); }
  int otherEnd(std::uint32_t edge) const { return firstEnd(edge) + offset_[edge % kDirections]; }
  std::size_t count() const { return begin_[kWeights]; }

 private:
  template <typename F>
  void forEachEdge(F visit) const;

  int width_ = 0, height_ = 0;
  std::array<int, kDirections> offset_{};  // from a pixel's index to its neighbour's
  ImageView<std::uint8_t> weights_;        // one row per image row and direction
  std::uint32_t* edges_ = nullptr;
  std::array<std::uint32_t, kWeights + 1> begin_{};
};

struct SegmentationParameters {
  float k;          ///< granularity, in grey levels times pixels; larger values give larger segments
  int min_size_px;  ///< smaller segments are joined to a neighbour
};

/// Room for segment() to work in. Its memory is taken from the current scope of an arena, so that several
/// threads may then divide an image at a time.
struct SegmentationScratch {
  explicit SegmentationScratch(const SortedEdges& edges, Arena& arena);

  struct Node {
    int parent;   ///< itself if it is the root of a component
    float limit;  ///< of a root: the largest weight that joins it to another
  };
  Node* nodes;
  int* size;  ///< of a root's component
  std::uint32_t* between;
};

/// Divides an image into segments. `labels`, one per pixel, receives their numbers row by row, 0 up to but
/// not including the returned count, in the order of their first pixels.
///
/// Every pixel begins as a component of its own. Edges, in their order, join two components A and B if
///     weight <= min(Int(A) + k / |A|, Int(B) + k / |B|),
/// where Int(C) is the largest weight among the edges that joined C together (0 for a single pixel). Then
/// edges, in the same order, join different components of which one has fewer than `min_size_px` pixels.
int segment(const SortedEdges& edges, const SegmentationParameters& parameters, std::int32_t* labels,
            const SegmentationScratch& scratch);

}  // namespace pomona
