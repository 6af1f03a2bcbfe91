// How good a disparity map is, counted as the Middlebury, ETH3D and KITTI benchmarks count.
//
// Maps are CV_32F in pixels; a value that is not finite is unknown. Masks are empty (every pixel counts) or
// CV_8U of the truth's size, and only pixels of value 255 count: Middlebury's and ETH3D's mask0nocc.png,
// where they are visible in both views. Figures are NaN where there is nothing to average. Every function
// throws std::invalid_argument if sizes or types do not fit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace pomona {

/// Errors above these many pixels are counted ("bad-0.5" and so on).
inline constexpr std::array<float, 4> kBadThresholds_px = {0.5f, 1.0f, 2.0f, 4.0f};
/// Error quantiles that are noted ("A50" and so on).
inline constexpr std::array<int, 4> kErrorQuantiles_percent = {50, 90, 95, 99};

/// What a benchmark does to a disparity before it is compared. The default does nothing.
struct EvaluationRules {
  static constexpr float kNoLimit = std::numeric_limits<float>::infinity();

  float clip_to_px = kNoLimit;      ///< known disparities are moved into [0, this], unless it is kNoLimit
  float hole_beyond_px = kNoLimit;  ///< |d| above this counts as a hole
  bool round = false;               ///< compare whole pixels, for truths that are whole

  /// Middlebury v3 SDK: clipped to [0, num_disparities].
  static EvaluationRules middlebury(int num_disparities) { return {.clip_to_px = float(num_disparities)}; }
  /// ETH3D two-view: what is larger than the image is wide is no disparity.
  static EvaluationRules eth3d(int width) { return {.hole_beyond_px = float(width)}; }
};

/// Errors over the n pixels whose truth is known. Shares are in percent; `threshold` is an index into
/// kBadThresholds_px.
struct DisparityErrors {
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

  std::int64_t known = 0;                                      ///< n, pixels compared
  std::int64_t holes = 0;                                      ///< of these, without a disparity
  std::array<std::int64_t, kBadThresholds_px.size()> wrong{};  ///< with one, off by more than the threshold
  double error_sum_px = 0;                                     ///< sum of |d - truth|, without holes
  double squared_error_sum_px2 = 0;                            ///< sum of (d - truth)^2, without holes
  /// For each of kErrorQuantiles_percent, entry floor(m q / 100) of the m sorted errors |d - truth|, holes
  /// left out.
  std::array<float, kErrorQuantiles_percent.size()> quantile_px = {kUnknown, kUnknown, kUnknown, kUnknown};

  std::int64_t found() const { return known - holes; }
  /// Wrong or a hole, of all known (Middlebury: "totbad").
  double badPercent(std::size_t threshold) const;
  /// Wrong, of all known (Middlebury: "bad" of a sparse map).
  double wrongOfKnownPercent(std::size_t threshold) const;
  /// Wrong, of those with a disparity: how far a sparse map can be trusted (ETH3D: "bad").
  double wrongPercent(std::size_t threshold) const;
  /// Holes, of all known (Middlebury: "invalid").
  double invalidPercent() const;
  /// Those with a disparity, of all known (ETH3D: "coverage").
  double coveragePercent() const;
  /// Mean |d - truth| over pixels with a disparity ("avgerr").
  double averageErrorPx() const;
  /// Root of the mean (d - truth)^2 over pixels with a disparity ("rms").
  double rmsErrorPx() const;
};

/// Compares `disparity` with `truth`, which may be exactly 1, 2 or 4 times as wide and as high: a pixel of
/// the truth then meets the one of the map that covers it, the disparity times the ratio, and errors count in
/// pixels of the truth. (The rules' limits are in pixels of the map.) A pixel is wrong if
/// |d - truth| > threshold, strictly.
DisparityErrors compareWithTruth(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& mask = {},
                                 const EvaluationRules& rules = {});

/// KITTI 2015's outliers: |d - truth| > 3 px and > 5 % of the truth, both strictly.
struct KittiErrors {
  struct Region {
    std::int64_t known = 0;     ///< pixels with known truth
    std::int64_t holes = 0;     ///< of these, without a disparity
    std::int64_t outliers = 0;  ///< with one, and too far off

    /// D1: outliers and holes, of all known, in percent. The benchmark scores filled maps only: give it one
    /// of fillRowsFromBackground().
    double d1Percent() const;
    /// Outliers, of those with a disparity, in percent: the benchmark's figure for what a method estimated.
    double outlierPercent() const;
  };
  Region background, foreground;
  Region all() const;
};

/// `object_map`: CV_8U, 0 background, else a vehicle (obj_map of the training set); empty: all is background.
/// With a mask of the non-occluded pixels: the benchmark's D1-noc, else its D1-occ.
KittiErrors kittiErrors(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& object_map = {},
                        const cv::Mat& mask = {});

/// Fills each hole of the CV_32F map with the smaller, so farther, of the nearest disparities left and right
/// of it in its row: what is hidden in one view is background. Rows without any disparity take the row above,
/// else the first below. KITTI's development kit fills sparse maps in this way before it scores them.
void fillRowsFromBackground(cv::Mat& disparity);

/// Middlebury's normalised run times: seconds per million pixels ("time/MP") ...
double secondsPerMegapixel(double seconds, cv::Size size);
/// ... and per 10^9 pixels times disparities searched ("time/GD").
double secondsPerGigadisparity(double seconds, cv::Size size, int num_disparities);

/// sum(w v) / sum(w) over the values that are not NaN. `weights`: empty (all 1), or one per value.
double weightedMean(std::span<const double> values, std::span<const double> weights = {});
/// The weight of a scene in the averages of Middlebury v3's training table: 0.5 for the five most difficult
/// ones (PianoL, Playroom, Playtable, Shelves, Vintage), 1 for any other name. Folders before the name, as in
/// "trainingQ/Shelves", make no difference.
double middleburyWeight(std::string_view scene);

/// How well a confidence tells right from wrong: pixels are dropped, least confident first, and the share of
/// bad ones among the rest is followed (X. Hu, P. Mordohai: A quantitative evaluation of confidence measures
/// for stereo vision. IEEE TPAMI 34(11), 2012).
struct CoverageCurve {
  struct Point {
    double coverage_percent;  ///< pixels kept, of all with known truth
    double wrong_percent;     ///< wrong, of those kept
    double oracle_percent;    ///< the same if those with the largest errors had been dropped first
  };
  std::vector<Point> points;  ///< from few pixels to all that have a disparity
  double area_percent = 0;    ///< mean of wrong_percent over all numbers of pixels kept
  double oracle_area_percent = 0;
  /// What the confidence loses to perfect knowledge; 0 is best.
  double excessAreaPercent() const { return area_percent - oracle_area_percent; }
};

/// `confidence`: CV_32F of the map's size, larger is surer; pixels without a disparity are left out. Pixels
/// of equal confidence are kept or dropped in proportion. Wrong is |d - truth| > threshold_px. `points`: at
/// most so many, evenly spaced; at least 1. Without any pixel to rank, no points and NaN areas.
CoverageCurve coverageCurve(const cv::Mat& disparity, const cv::Mat& confidence, const cv::Mat& truth,
                            const cv::Mat& mask = {}, float threshold_px = 1.0f, int points = 100);

/// Errors of the inliers, by the fractional part of the true disparity: whether a method prefers whole pixels
/// ("pixel locking").
struct SubpixelErrors {
  struct Bin {
    std::int64_t count = 0;
    double error_sum_px = 0;           ///< sum of d - truth
    double squared_error_sum_px2 = 0;  ///< sum of (d - truth)^2

    double biasPx() const;
    double rmsPx() const;
  };
  std::vector<Bin> bins;  ///< bin k of n: truth - floor(truth) in [k / n, (k + 1) / n)
  Bin all;
};

/// Inliers have |d - truth| <= inlier_px. `bins` is at least 1.
SubpixelErrors subpixelErrors(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& mask = {},
                              int bins = 10, float inlier_px = 1.0f);

/// Whether predicted standard deviations are true to scale: of normally distributed errors, 68.3, 95.4 and
/// 99.7 % lie within 1, 2 and 3 sigma.
struct SigmaCalibration {
  std::int64_t count = 0;                  ///< pixels with known truth, disparity and sigma
  std::array<std::int64_t, 3> within{};    ///< of these, with |d - truth| <= 1, 2, 3 sigma
  double withinPercent(int sigmas) const;  ///< sigmas: 1, 2 or 3
};

/// `sigma`: CV_32F of the map's size, pixels, >= 0; values that are not finite, or negative, are left out.
SigmaCalibration sigmaCalibration(const cv::Mat& disparity, const cv::Mat& sigma, const cv::Mat& truth,
                                  const cv::Mat& mask = {});

}  // namespace pomona
