// Holes filled with the planes that the measured pixels of their colour segments lie on.
#pragma once

#include <array>
#include <cstdint>

#include "core/image.h"
#include "pyramid/kernels.h"
#include "pyramid/scale.h"
#include "pyramid/segmentation.h"

namespace pomona {

/// Everything has the size of the left image; sides are at most 32767.
struct PlaneFillInput {
  GuideView guide;                         ///< the left image
  ImageView<const float> right_disparity;  ///< the right view's map, d = x_left - x_right; NaN where unknown
  int scale = 4;            ///< segments are found in the image reduced so many times; 1, 2 or 4
  float min_disparity = 0;  ///< a plane fills with disparities from here ...
  float max_disparity = 0;  ///< ... up to and including here
};

/// What fillFromPlanes() keeps from one call to the next.
struct PlaneFillScratch {
  /// One division of the image into segments.
  struct Segments {
    int count;
    Image<std::int32_t> labels;
    SegmentationScratch segmentation;
    Buffer<int> begin;  ///< segment i owns cells[begin[i]] up to, not including, cells[begin[i + 1]]
    Buffer<int> cells;
  };
  ScaleScratch scale;
  Image<std::uint8_t> reduced_guide;
  SortedEdges edges;
  std::array<Segments, 3> segments;
  Buffer<int> column_begin, row_begin;  ///< the image's pixels under each cell
  Image<std::uint8_t> sources, holes;   ///< how many of them there are in each cell
  Image<std::uint16_t> column_sums;
};

/// Fills holes (see holes.h) of `disparity` in place and gives them state kFilledPlane. Other pixels keep
/// their bytes, and holes that no plane suits stay holes.
///
/// The guide, reduced by area averaging, is divided into segments three times: with k = 100 / scale, three
/// and nine times that; segments have at least 50 px of the full image. From the finest to the coarsest,
/// every segment that still has holes gets a robust plane (see plane_fit.h) through its sources, if these are
/// at least twelve and cover 30 % of it (10 % at the coarsest) and if 70 % (50 %) of them lie near the plane.
/// Its holes take the plane's disparities where these are within the range and hide nothing that the right
/// view sees. The result does not depend on the number of threads.
void fillFromPlanes(const PlaneFillInput& in, ImageView<float> disparity, ImageView<std::uint8_t> state,
                    PlaneFillScratch& scratch, const PyramidKernels& kernels, int threads);

}  // namespace pomona
