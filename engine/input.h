// What a caller hands in, checked and brought into the forms the stages work on.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "core/cpu.h"
#include "core/image.h"
#include "pomona/options.h"
#include "sgm/kernels.h"
#include "sgm/matcher.h"

namespace pomona {

/// A pair in working form: gray is (29 B + 150 G + 77 R) / 256. Views point into the caller's images where
/// these already have the right form, otherwise into buffers that are reused from frame to frame.
class InputPair {
 public:
  /// Throws std::invalid_argument naming the argument, what it is and what is allowed.
  void set(const cv::Mat& left, const cv::Mat& right, int threads,
           const SgmKernels& kernels = sgmKernels(chooseIsa({})));

  int width() const { return views_.left.width; }
  int height() const { return views_.left.height; }
  /// The guide has the caller's number of channels.
  const MatchInput& views() const { return views_; }

 private:
  struct Buffers {
    Image<std::uint8_t> gray8;
    Image<std::uint16_t> gray16;
  };
  MatchInput views_;
  Buffers buffers_[2];
  Image<std::uint8_t> guide8_;
};

/// Throws if the searched range does not suit the image: at least one disparity must map into it, and there
/// may not be more disparities than columns.
void requireRangeFits(int min_disparity, int num_disparities, int width);

/// Throws unless `mask` is empty or CV_8U with the size of `left`.
void requireMaskFits(const cv::Mat& mask, const cv::Mat& left);
/// An empty view of an empty mask.
ImageView<const std::uint8_t> maskView(const cv::Mat& mask);
/// The mask for a pair reduced to width x height: each pixel's value is that at the middle of what it covers.
/// An empty mask stays empty; otherwise the view is of `buffer`.
ImageView<const std::uint8_t> shrunkMask(ImageView<const std::uint8_t> mask, int width, int height,
                                         Image<std::uint8_t>& buffer);

}  // namespace pomona
