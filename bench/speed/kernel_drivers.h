// Stages that are run for the sake of the kernels they use.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "bench/speed/inputs.h"
#include "camera/row_align.h"
#include "camera/row_check.h"
#include "engine/input.h"
#include "engine/trust.h"
#include "filters/joint_bilateral.h"
#include "filters/left_right.h"
#include "filters/median.h"
#include "filters/plane_refine.h"
#include "filters/speckle.h"
#include "filters/weighted_median.h"
#include "pomona/options.h"
#include "pyramid/fusion.h"
#include "pyramid/hole_fill.h"
#include "pyramid/plane_fill.h"
#include "pyramid/scale.h"
#include "sgm/matcher.h"

namespace pomona {

/// The function tables that a stage is handed.
struct KernelTables {
  SgmKernels sgm;
  FilterKernels filters;
  PyramidKernels pyramid;
  CameraKernels camera;
};

/// What the stages work on: the pair, and the maps that the stages before them make of it.
struct KernelMaterial {
  KernelMaterial(const FrameSize& frame_size, const BenchmarkInputs& inputs);

  GuideView guide() const { return input.views().guide; }
  GuideView quarterGuide() const {
    return {quarter_guide.row(0), quarter_sparse.width(), quarter_sparse.height(), 3,
            quarter_guide.view().stride};
  }

  FrameSize size;
  ImagePair pair;
  InputPair input;
  Options options;  ///< of the preset `balanced`
  Image<std::uint16_t> left16, right16;
  cv::Mat deep_left, deep_right;  ///< 16-bit colour
  Image<float> sparse_disparity, right_disparity, dense;
  Image<std::uint8_t> sparse_state;
  Image<std::uint8_t> quarter_guide;
  Image<float> quarter_sparse, quarter_dense;
  std::array<std::uint8_t, 65536> cost_table;

  // Outputs and scratch.
  InputPair made_gray;
  RowCheck row_check;
  Image<std::uint8_t> moved;
  Image<std::uint16_t> moved16;
  SgmMatcher matcher;
  MatchMaps matched;
  Image<float> disparity, quarter_disparity;
  Image<std::uint8_t> state, small;
  Image<std::uint16_t> small16;
  MatchMaps trusted;
  Trust trust;
  LeftRightScratch left_right;
  SpeckleScratch speckle;
  MedianScratch median;
  BilateralScratch bilateral;
  WeightedMedianScratch weighted_median;
  GuidedPlane plane_refine;
  ScaleScratch scale;
  FusionScratch fusion;
  PlaneFillScratch plane_fill;
  HoleFillScratch hole_fill;
  SortedEdges edges;
};

struct KernelDriver {
  const char* name;
  double pixels = 1;  ///< that it works on, as a share of the frame's
  std::function<void(KernelMaterial&, const KernelTables&)> run;
  CostOptions cost = {};  ///< of those that match
  AggregationOptions aggregation = {};
};

/// Together they call every kernel there is.
std::vector<KernelDriver> kernelDrivers();

}  // namespace pomona
