// Where in an image a known object lies.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "plugins/common/disparity_plane.h"
#include "plugins/common/object_match.h"

namespace pomona {

enum class PlaceModel {
  kHomography,   ///< as published: a homography, of all matches
  kAffineFirst,  ///< an affine map, of the matches that turn alike; then the homography near it, if more
                 ///< agree
};

struct LocateOptions {
  PlaceModel model = PlaceModel::kAffineFirst;
  double ratio = 0.8;          ///< matches up to this ratio count
  double reprojection_px = 3;  ///< of matches that agree
  int min_agreeing = 6;        ///< at least 4
  double min_area_px = 100;    ///< smallest plausible outline
};

/// Where a flat object lies in the image.
struct ObjectPlace {
  /// Why it was not found; empty if it was.
  std::string why_not;
  bool found() const { return why_not.empty(); }

  cv::Matx33d image_from_picture = cv::Matx33d::eye();
  std::vector<cv::Point2f> outline_px;  ///< the picture's corners, clockwise from the top left
  cv::Point2d middle_px;                ///< where the picture's middle is seen
  double middle_sigma_px = 0;  ///< of middle_px, along each axis: by what the agreeing matches are off
  std::vector<ObjectMatch> agreeing;
};

/// A map between picture and image from `matches` of `object` (others are left out), by RANSAC. It must be
/// plausible: a convex outline that is not mirrored, at least min_area_px large, and around the agreeing
/// features.
ObjectPlace locateObject(const KnownObject& object, int object_number,
                         const std::vector<cv::KeyPoint>& keypoints, std::span<const ObjectMatch> matches,
                         const LocateOptions& options);

/// Likewise, for an object whose surface is known: `plane` is its disparity in the rectified left view, plus
/// the rig's doffs, so that Z is inversely proportional to it. Its perspective being known, the map is affine
/// on it, and the object's far end agrees as well as the near one.
ObjectPlace locateOnPlane(const KnownObject& object, int object_number,
                          const std::vector<cv::KeyPoint>& keypoints, std::span<const ObjectMatch> matches,
                          const DisparityPlane& plane, const LocateOptions& options);

/// The image's point that shows `place` of the picture.
cv::Point2d mapped(const cv::Matx33d& image_from_picture, const cv::Point2d& place);

}  // namespace pomona
