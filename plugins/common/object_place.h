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
  /// At least 4. With kAffineFirst two fewer do, though not less than 4, where likeness() is 0.9 or more.
  int min_agreeing = 6;
  double min_area_px = 100;    ///< smallest plausible outline
  double min_likeness = 0.65;  ///< likeness() at the object's place; kAffineFirst only
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

/// What there is to be known of an image (CV_8U, 1 channel): its features, and the nearest known one of each.
struct SeenView {
  const cv::Mat& gray;
  const Features& features;
  std::span<const ObjectMatch> matches;
};

/// A map between picture and image from the matches of `object`, by RANSAC. It must be plausible: a convex
/// outline that is not mirrored, at least min_area_px large, no corner three times as far as another. With
/// kAffineFirst, four matches are enough for a first map, if guidedMatches() finds the others, and the view
/// must look like the picture there.
ObjectPlace locateObject(const KnownObject& object, int object_number, const SeenView& view,
                         const LocateOptions& options);

/// Likewise, for an object whose surface is known: `plane` is its disparity in the rectified left view, plus
/// the rig's doffs, so that Z is inversely proportional to it. Its perspective being known, the map is affine
/// on it, and the object's far end agrees as well as the near one.
ObjectPlace locateOnPlane(const KnownObject& object, int object_number, const SeenView& view,
                          const DisparityPlane& plane, const LocateOptions& options);

/// The image's point that shows `place` of the picture.
cv::Point2d mapped(const cv::Matx33d& image_from_picture, const cv::Point2d& place);

}  // namespace pomona
