// Which features of an image belong to which place on which known object.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "plugins/common/object_database.h"

namespace pomona {

/// A feature of the image and its nearest neighbour in the database.
struct ObjectMatch {
  int query = 0;       ///< number of the image's feature
  int object = 0;      ///< ObjectDatabase::objects
  int feature = 0;     ///< KnownObject::features
  float distance = 0;  ///< of the descriptors, which are of unit length
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
  bool fitsBytes() const;
  cv::Mat comparable(const cv::Mat& descriptors) const;
  bool isSamePlace(const Place& a, const Place& b) const;

  const ObjectDatabase& database_;
  std::vector<View> views_;
};

}  // namespace pomona
