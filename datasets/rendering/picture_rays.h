// The directions in which a camera's pixels look.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "datasets/render.h"

namespace pomona {

/// Of an ideal camera, and of the one that takes the pictures.
class PictureRays {
 public:
  /// `camera`: which takes the pictures, if not the ideal one. Throws std::invalid_argument if some pixel of
  /// it looks nowhere, or backwards.
  PictureRays(cv::Size size, double focal_px, const cv::Vec2d& principal_px,
              const std::optional<PictureCamera>& camera, int threads);

  /// Of the ideal camera: (x, y, 1).
  cv::Vec3d ideal(double x, double y) const {
    return {(x - principal_[0]) / focal_, (y - principal_[1]) / focal_, 1};
  }
  /// Of the picture: of the place (x + dx, y + dy) inside of pixel (x, y), |dx|, |dy| <= 0.5.
  cv::Vec3d taken(int x, int y, double dx, double dy) const;

  /// Contains all of these directions' (x, y).
  cv::Rect2d range() const;

 private:
  cv::Size size_;
  double focal_;
  cv::Vec2d principal_;
  cv::Mat corners_;  // CV_64FC2: directions of the pixels' corners; empty without a camera
};

}  // namespace pomona
