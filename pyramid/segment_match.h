// The disparity of a whole colour segment: what no pixel of a bare surface can tell alone, all of them
// together may.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/arena.h"
#include "core/image.h"
#include "pyramid/kernels.h"
#include "pyramid/plane_fit.h"
#include "pyramid/segment_cells.h"

namespace pomona {

/// A segment of a division of the image into cells.
struct Segment {
  std::span<const SegmentCells::Cell> members;
  const SegmentCells& cells;
  const std::int32_t* labels;  ///< the segment of every cell, row by row

  SegmentCells::Pixel origin() const { return cells.firstPixel(members[0]); }
};

/// Correlates the faint texture of segments, all at once. Of each view, only what differs little from the
/// mean of the 5x5 pixels around it is looked at: up to 2.5 gray values. So edges, which tell of other
/// surfaces, do not count, and neither do pixels within about 4 px of another segment.
///
/// A disparity's score is sum(a b) / sqrt(sum(b b)), with a and b the differences from that mean in the left
/// and in the right view, over the pixels of the segment. Where nothing matches, scores spread around 0 with
/// one deviation; a surface that is level to within a pixel or so raises that of its disparity above it.
class SegmentMatch {
 public:
  struct Level {
    float disparity;   ///< below the pixel by a parabola
    double score;      ///< its own
    double deviation;  ///< of the scores of other disparities
  };

  /// The views are gray and of equal size, or empty: no level stands out then. Disparities are searched from
  /// `min_disparity` up, at most kMostDisparities. What is made of them lies in the current scope of `arena`,
  /// and they are to stay as they are.
  void prepare(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, int min_disparity,
               int disparities, const PyramidKernels& kernels, Arena& arena);

  /// Texture is looked at only where segments ask for it, as most images have few that do. Each one is to be
  /// announced, and then all of them read, before its level or a score is asked for.
  void announce(const Segment& segment);
  void readAnnounced(int threads);

  /// The disparity that stands out, if one does: by 4 deviations above the mean of the scores more than 2 px
  /// away, and by 1.5 above the best of them. None does if the segment has fewer than 1000 px to compare, if
  /// they leave the right view (or meet edges there) at more than half of the disparities, or if half of its
  /// texture's energy does so at the best.
  std::optional<Level> levelOf(const Segment& segment) const;

  /// The score of a plane whose origin is that of the segment, with its disparities kept within those of its
  /// inliers and kPlaneTolerance_px.
  double scoreOf(const Segment& segment, const PlaneFit& fit) const;

  static constexpr int kMostDisparities = 1024;

 private:
  enum class RowState : std::uint8_t { kUnread, kAnnounced, kRead };

  template <typename F>
  void forEachInnerCell(const Segment& segment, F visit) const;
  int innerPixels(const Segment& segment) const;
  template <typename F>
  void forEachInnerRow(const Segment& segment, F visit) const;
  // What left pixel (x, y) meets at the largest disparity, at the next smaller one ...
  const std::int8_t* rightOf(int x, int y) const { return right_.row(y) + offset_ + x; }

  const PyramidKernels* kernels_ = nullptr;
  int min_disparity_ = 0, disparities_ = 0;
  int offset_ = 0;  // see rightOf()
  ImageView<const std::uint8_t> left_view_, right_view_;
  RowState* rows_ = nullptr;
  ImageView<std::int8_t>
      left_;  // differences from the local mean, in 1/25 gray values; 0 if they are too large
  ImageView<std::int8_t> right_;  // the same, with zeros for the columns outside
};

}  // namespace pomona
