// Everything a caller can set, one struct per stage of the frame's journey.
#pragma once

#include <string>
#include <string_view>

namespace pomona {

enum class MatchingCost {
  kCensus5x5,                 ///< 24-bit census (Zabih & Woodfill 1994), cost 0..24
  kCensus7x7,                 ///< 48-bit census, cost 0..48
  kCensus9x7,                 ///< 62-bit census, cost 0..62
  kCenterSymmetricCensus9x7,  ///< 31-bit centre-symmetric census (Spangenberg et al. 2013), cost 0..31
  kMutualInformation,         ///< hierarchical mutual information (Hirschmueller 2008), cost 0..127
  kBlended,  ///< 30-bit checkerboard census 9x7 + truncated horizontal Sobel and gray differences, cost 0..45
};

struct CostOptions {
  MatchingCost cost = MatchingCost::kBlended;
  /// Average the costs of a pixel and those of its 4-neighbours whose colour differs by less than this
  /// (largest channel difference, 8-bit units; Zhang et al. 2009, with arms of one pixel); 0 (off) to 255.
  int support_color_step = 8;
};

/// g is the largest channel difference |I(p) - I(q)| between a pixel and its predecessor on the path, 8-bit
/// units.
enum class PenaltyAdaptation {
  kConstant,          ///< P2 everywhere
  kInverseIntensity,  ///< P2' = max(P1, P2 / g)   (Hirschmueller 2008, below Eq. 13)
  kSoftIntensity,     ///< P2' = max(p2_min, P2 / (1 + g / 10))
};

/// Semi-global aggregation. Penalties are in units of the matching cost.
/// Path costs live in 8 bits, so the largest cost + p1 + p2 must not exceed 255.
struct AggregationOptions {
  int paths = 4;    ///< 4 (horizontal and vertical) or 8 (and diagonal)
  int p1 = 14;      ///< penalty for a disparity step of one; 1 <= p1 <= p2
  int p2 = 63;      ///< penalty for a larger step
  int p2_min = 20;  ///< lower bound of the adapted penalty (kSoftIntensity); p1 <= p2_min <= p2
  PenaltyAdaptation adaptation = PenaltyAdaptation::kSoftIntensity;
};

enum class SubpixelMethod {
  kNone,         ///< whole pixels
  kParabola,     ///< vertex of the parabola through three costs
  kEquiangular,  ///< apex of two lines of equal and opposite slope (Shimizu & Okutomi 2001)
  kFitted,       ///< a curve fitted to the blended cost on rendered scenes (bench/subpixel)
};

struct WinnerOptions {
  SubpixelMethod subpixel = SubpixelMethod::kFitted;
  /// Reject a pixel if its best cost is not at least this many percent below the best cost found more than
  /// one disparity away. 0 accepts everything; 0..100.
  int uniqueness_percent = 0;
};

struct ValidationOptions {
  /// Largest |d_left - d_right| in pixels that passes; a negative value switches the check off. Stricter maps
  /// hold fewer pixels and fewer wrong ones (docs/presets.md).
  float left_right_px = 2.5f;
  /// Connected regions (4-neighbours, disparity steps up to speckle_step_px) of fewer pixels are removed; 0:
  /// off.
  int speckle_size_px = 50;
  float speckle_step_px = 1.0f;
  int median_size = 3;  ///< 0 (off), 3 or 5
  /// Sparse maps only, after all else: what is less likely than this to be right to within a pixel becomes
  /// kAmbiguous. 0 (off) to 1; 0.9 drops little, 0.95 is strict, 0.98 keeps the best only.
  float min_confidence = 0;
};

enum class CompletionMethod {
  /// Holes filled from their surroundings, coarse maps as the last resort; then the whole map refined.
  kFillHoles,
  kPaper,  ///< the seed paper: coarse maps only, bilateral on every pixel, equal-weight fusion
};

struct CompletionOptions {
  CompletionMethod method = CompletionMethod::kFillHoles;
  /// kFillHoles spreads measured disparities over holes, so it may be stricter about which pixels count as
  /// measured than a sparse map is: these two take the place of left_right_px and speckle_size_px.
  float seed_left_right_px = 0.7f;
  int seed_speckle_size_px = 100;
  /// kFillHoles: holes first take the plane that the measured pixels of their colour segment lie on.
  bool segment_planes = true;
  /// Segments are found in the image reduced so many times: 1, 2 or 4. The default is both the best and the
  /// fastest.
  int segment_scale = 4;
  /// Smaller segments come first, those of nearly one colour; then the larger ones, which join what is alike.
  bool fine_segments = true;
  /// A hole is filled from pixels, measured or on segment planes, at most this far away (along a search ray);
  /// farther away the coarse maps decide. At least 1.
  int search_radius_px = 200;
  /// kFillHoles: move the jumps of the dense map to the edges of the left image, by a colour-weighted median
  /// near jumps of more than 1 px. This and the next two change measured pixels, too.
  bool weighted_median = true;
  int median_size = 5;  ///< kFillHoles: then a median of the whole map; 0 (off), 3 or 5
  /// kFillHoles: replace each disparity by a plane through the neighbours of like disparity and colour.
  bool plane_refinement = true;
  int refine_radius_px = 2;  ///< of the window of that plane: 2 or 3
  float sigma_space_px =
      10.0f;                  ///< joint bilateral: spatial standard deviation, at the coarse scale (sigma_s)
  float sigma_range = 30.0f;  ///< joint bilateral: guide-image standard deviation, 8-bit units (sigma_r)
  int pyramid_levels = 6;     ///< Laplacian pyramid levels of the fusion, 1..16
};

/// A second match of the whole frame, drawn towards the completed map of the first.
struct SecondPassOptions {
  bool enabled = false;  ///< dense maps completed by kFillHoles only
  /// The matching cost grows by weight * min(|d - d_first|, reach_px).
  int weight = 1;    ///< 1..16
  int reach_px = 4;  ///< 1..16; the largest cost + weight * reach_px + p1 + p2 must not exceed 255
  CostOptions cost = {MatchingCost::kBlended, 0};
  AggregationOptions aggregation = {4, 3, 24, 6, PenaltyAdaptation::kSoftIntensity};
};

enum class OutputMode {
  kSparse,  ///< measured pixels only
  kDense,   ///< every pixel that the mask does not exclude
};

/// How aggregation keeps the sums of its first pass until the second completes them. The results are the
/// same.
enum class MemoryMode {
  kAutomatic,  ///< kSpeed while the sums take at most 256 MiB, else kLow
  kSpeed,  ///< all of them: one byte per pixel and disparity, two if p2 > 63 (4 paths: if cost + p2 > 127)
  kLow,    ///< a few rows of them, computed a second time: memory grows with the root of the height
};

struct Options {
  int min_disparity = 0;     ///< smallest disparity searched, pixels; may be negative
  int num_disparities = 64;  ///< number of disparities searched, 1..1024; at most the image width
  /// Look at a quarter of the size first, and search each band of rows only for the disparities found in it;
  /// for all of the above in rows that have a part where too little was found to be sure. Faster where the
  /// scene needs fewer disparities than are searched, by multiples of 64: ranges of up to 64 stay as they
  /// are. A disparity that the look did not find, though it found others around, may be missed: of the true
  /// ones of real scenes one in some thousands (docs/benchmarking.md). Not for dense maps of
  /// CompletionMethod::kPaper, which match nothing at full size.
  bool adaptive_range = false;
  OutputMode mode = OutputMode::kDense;

  CostOptions cost;
  AggregationOptions aggregation;
  WinnerOptions winner;
  ValidationOptions validation;
  CompletionOptions completion;
  SecondPassOptions second_pass;

  /// Measure the vertical offset between the views (StereoResult::row_offset_px): about 1 ms.
  bool row_check = true;
  /// Where it finds one of 0.1 px or more that its points agree on, move the rows of the right view by it
  /// before matching (StereoResult::rows_aligned).
  bool align_rows = true;

  MemoryMode memory = MemoryMode::kAutomatic;
  int threads = 0;  ///< worker threads; 0: one per available processor; at most 1024
  std::string
      isa;  ///< "scalar", "avx2", "avx512", "neon"; empty: POMONA_ISA if set, else the best the CPU has

  /// Throws std::invalid_argument naming the field, its value and the allowed range.
  void validate() const;

  /// "fast", "balanced" (the default), "quality" or "paper"; throws std::invalid_argument for another name.
  static Options preset(std::string_view name);
};

/// Largest value the matching cost can take.
int maximumCost(MatchingCost cost);

}  // namespace pomona
