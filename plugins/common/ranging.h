// From the features of two rectified views to points in metres.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "plugins/common/matching.h"
#include "plugins/common/refine_disparity.h"
#include "plugins/common/sift.h"
#include "pomona/calibration.h"
#include "pomona/plugin_settings.h"
#include "pomona/sparse_result.h"

namespace pomona {

struct RangingOptions {
  MatchOptions matching;
  RowBand band;            ///< matches have to lie in it ...
  bool along_rows = true;  ///< ... and are searched for there alone; else among all features
  bool refine = true;      ///< matches whose windows don't register are dropped
  RefineOptions refinement;
  float sigma_px = 0.5f;  ///< of disparities that are not refined
};

/// The parameters that rangingOptions() reads, with these defaults: along_rows, ratio, mutual,
/// max_row_offset_px, min_disparity_px, refine, window_radius_px, max_step_px, min_correlation, sigma_px.
std::vector<PluginParameter> rangingParameters(const RangingOptions& defaults);
RangingOptions rangingOptions(const PluginSettings& settings);

struct RangedMatches {
  int matches = 0;  ///< that lie in the band
  std::vector<SparsePoint> points;
  double matching_ms = 0, refinement_ms = 0;
};

/// `left_gray`, `right_gray`: CV_8UC1, the views that the features are of.
RangedMatches rangeMatches(const cv::Mat& left_gray, const cv::Mat& right_gray, const ViewFeatures& left,
                           const ViewFeatures& right, const StereoCalibration& calibration,
                           const RangingOptions& options);

/// Numbers of features, matches and points, and the times; `features_ms` is that of finding features.
std::vector<SparseFigure> figuresOf(const ViewFeatures& left, const ViewFeatures& right,
                                    const RangedMatches& ranged, double features_ms);

}  // namespace pomona
