// Which features of an image belong to which place on which known object, and where in the image the object
// lies.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "plugins/common/object_database.h"

namespace pomona {

/// A feature of the image and its nearest neighbour in the database.
struct ObjectMatch {
  int query = 0;    ///< number of the image's feature
  int object = 0;   ///< ObjectDatabase::objects
  int feature = 0;  ///< KnownObject::features
  float distance = 0;
  /// By the distance to the nearest feature of any other place (Lowe 2004): 0 unmistakable, 1 arbitrary.
  float ratio = 1;
};

/// Compares with a database, which must outlive it.
class ObjectMatcher {
 public:
  explicit ObjectMatcher(const ObjectDatabase& database);

  FeatureKind kind() const { return database_.kind; }

  /// The nearest neighbour of each row of `descriptors`, in their order; rows that are equally near to two of
  /// the database are left out. Views of one object that show the same place (to a twentieth of its size)
  /// don't compete with each other.
  std::vector<ObjectMatch> match(const cv::Mat& descriptors) const;

 private:
  struct Place {
    int object, feature;
  };
  // What all objects look like from one direction.
  struct View {
    std::vector<Place> places;
    cv::Mat descriptors;
  };
  cv::Mat comparable(const cv::Mat& descriptors) const;
  bool isSamePlace(const Place& a, const Place& b) const;

  const ObjectDatabase& database_;
  std::vector<View> views_;
};

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
  std::vector<ObjectMatch> agreeing;
};

/// A map between picture and image from `matches` of `object` (others are left out), by RANSAC. It must be
/// plausible: a convex outline that is not mirrored, at least min_area_px large, and around the agreeing
/// features.
ObjectPlace locateObject(const KnownObject& object, int object_number,
                         const std::vector<cv::KeyPoint>& keypoints, std::span<const ObjectMatch> matches,
                         const LocateOptions& options);

/// The image's point that shows `place` of the picture.
cv::Point2d mapped(const cv::Matx33d& image_from_picture, const cv::Point2d& place);

}  // namespace pomona
