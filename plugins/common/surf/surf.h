// SURF, which Debian's OpenCV lacks, as a feature of OpenCV's. Its patents: plugins/common/SURF.md.
#pragma once

#include <opencv2/features2d.hpp>
#include <string>
#include <vector>

#include "plugins/common/surf/surf_options.h"

namespace pomona {

/// Speeded-Up Robust Features (Bay, Ess, Tuytelaars, Van Gool: Computer Vision and Image Understanding 110,
/// 2008).
///
/// Images: CV_8UC1 or CV_8UC3 (BGR), any size. Masks: CV_8UC1 of the image's size, points are kept where it
/// is not 0. Of a keypoint, `size` is the side of the best box filter in px, as in OpenCV's SURF, so that the
/// scale is size * 1.2 / 9 and the descriptor covers 20 of those; `angle` is in degrees in [0, 360),
/// clockwise on the screen, and -1 if upright; `response` the determinant of the Hessian; `octave` counts
/// from 0; `class_id` is 1 for dark blobs on bright ground and -1 for bright ones on dark ground: only equal
/// ones can match. Descriptors are rows of CV_32F of length 1, to be compared by NORM_L2.
///
/// The order of the keypoints, and every bit of the result, is the same for any number of threads.
class Surf final : public cv::Feature2D {
 public:
  /// Throws std::invalid_argument for options outside their ranges.
  static cv::Ptr<Surf> create(const SurfOptions& options = {});
  explicit Surf(const SurfOptions& options);

  /// With `use_provided`, describes the given keypoints, whatever the mask says, and gives an angle to those
  /// that have none (-1). Throws std::invalid_argument for other types of image or mask, for a mask of
  /// another size, and for provided keypoints outside the image or whose size is not in (0, 480] px.
  void detectAndCompute(cv::InputArray image, cv::InputArray mask, std::vector<cv::KeyPoint>& keypoints,
                        cv::OutputArray descriptors, bool use_provided = false) override;

  int descriptorSize() const override;
  int descriptorType() const override { return CV_32F; }
  int defaultNorm() const override { return cv::NORM_L2; }
  bool empty() const override { return false; }
  cv::String getDefaultName() const override { return "Feature2D.PomonaSurf"; }

  const SurfOptions& options() const { return options_; }

 private:
  SurfOptions options_;
};

}  // namespace pomona
