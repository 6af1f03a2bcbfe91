// Slanted planes, on which the true fractions of a pixel are evenly spread, and what a sub-pixel method makes
// of them.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "datasets/render.h"
#include "pomona/evaluation.h"
#include "pomona/options.h"

namespace pomona {

struct Texture {
  const char* name;
  double cell_px;   ///< of the coarsest of three octaves, as seen in the image
  double contrast;  ///< between the two paints, gray levels
};

/// Fine, middle, coarse, and one that is faint.
std::span<const Texture> textures();

constexpr int kPlaneDisparities = 64;
constexpr int kTilts = 3;

/// A plane of `texture` that fills 640x400 pixels, slanted one way for each `tilt` below kTilts.
RenderedPair slantedPlane(const Texture& texture, int tilt);

/// Adds independent noise of the given standard deviation to a view.
void addNoise(cv::Mat& view, double sigma, std::uint64_t seed);

/// How the fractions of found disparities spread over [0, 1), and their errors by the fraction of the truth.
class FractionStatistics {
 public:
  static constexpr int kBins = 20;
  static constexpr int kBiasBins = 10;

  /// Counts the pixels of a left view that both cameras see, if `disparity` is within a pixel of the truth.
  void add(const cv::Mat& disparity, const RenderedView& left);
  void add(const FractionStatistics& other);

  /// Root of the mean square by which the shares of the bins differ from an even spread, in shares of it:
  /// sqrt(chi-square / n). 0 is flat; whole disparities give sqrt(kBins - 1).
  double unevenness() const;
  /// The fullest bin, in shares of an even one.
  double fullest() const;
  double share(int bin) const;  ///< in shares of an even one

  double rmsPx() const { return errors_.all.rmsPx(); }
  /// The largest less the smallest bias of tenths of a pixel.
  double swingPx() const;

 private:
  void merge(const SubpixelErrors& errors);

  std::int64_t counts_[kBins] = {};
  std::int64_t total_ = 0;
  SubpixelErrors errors_{std::vector<SubpixelErrors::Bin>(kBiasBins), {}};
};

enum class PlaneMap {
  kRaw,     ///< winners, unchecked, unsmoothed
  kSparse,  ///< with the preset's checks and median
  kDense,   ///< completed and refined
};

/// `balanced` with another sub-pixel method.
Options planeOptions(SubpixelMethod method, PlaneMap map);

}  // namespace pomona
