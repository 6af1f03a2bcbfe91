// Local methods: every pixel is matched by the window around it, and by nothing else.
#pragma once

#include "baselines/method.h"
#include "baselines/winner.h"

namespace pomona {

/// What is common to SSD, NCC and ASW: checks of the input, winner-take-all, post-processing. Colour counts,
/// 16-bit views are matched with all their bits, and windows end where their view ends or repeat its border.
class WindowMethod : public Method {
 public:
  MethodResult run(const cv::Mat& left, const cv::Mat& right, const MethodOptions& options) final;

 protected:
  /// The unvalidated maps of a pair that has been checked.
  virtual WindowMaps match(const cv::Mat& left, const cv::Mat& right, SearchRange range,
                           WinnerPosition position, int threads) = 0;
};

}  // namespace pomona
