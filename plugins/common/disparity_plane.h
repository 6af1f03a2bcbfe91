// The disparities of a flat thing: an affine function of the place in the left view.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace pomona {

/// A plane Z = Z(X, Y) before a rectified pair has disparities d = d0 + slope_x (x - x0) + slope_y (y - y0).
struct DisparityPlane {
  cv::Point2d origin_px;
  double disparity_px = 0;  ///< d0, at the origin
  double slope_x = 0, slope_y = 0;
  double sigma_px = 0;  ///< of d0

  double at(const cv::Point2d& place) const {
    return disparity_px + slope_x * (place.x - origin_px.x) + slope_y * (place.y - origin_px.y);
  }
};

/// A place in the left view and its disparity.
struct PlaceDisparity {
  cv::Point2d left_px;
  double disparity_px = 0;
};

/// The plane that most of the points agree with, to `tolerance_px`; tries all of a few hundred fixed triples.
/// Nothing if fewer than `min_agreeing` (at least 3) do.
std::optional<DisparityPlane> fitDisparityPlane(const std::vector<PlaceDisparity>& points,
                                                const cv::Point2d& origin_px, double tolerance_px,
                                                int min_agreeing);

/// Moves `start` so that the right view, looked at through the plane and corrected by a factor and an offset
/// of brightness, becomes like the left one inside `outline_px` (convex): Gauss and Newton's least squares,
/// with Huber's weights (Lucas & Kanade 1981; Baker & Matthews 2004). `left`, `right`: CV_8U, 1 channel.
/// `start` must be right to about 2 px. Nothing if it leaves that range, or if the views don't become alike.
std::optional<DisparityPlane> alignDisparityPlane(const cv::Mat& left, const cv::Mat& right,
                                                  const std::vector<cv::Point2f>& outline_px,
                                                  const DisparityPlane& start);

}  // namespace pomona
