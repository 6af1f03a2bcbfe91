// What objects look like, learned once from a picture of each.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "plugins/common/object_features.h"

namespace pomona {

/// A flat object, or a flat side of one.
struct KnownObject {
  std::string label;
  cv::Size size_px;   ///< of its picture; its outline is the picture's border
  cv::Mat thumbnail;  ///< of its picture: thumbnailOf()
  /// Places in the picture, in pixels; class_id is the number of the view it was seen in, 0 the picture
  /// itself.
  Features features;
};

struct ObjectDatabase {
  FeatureKind kind = FeatureKind::kSift;
  std::vector<KnownObject> objects;
};

/// From which directions objects are to be recognised. Each adds a view, made by warping the picture, beside
/// the picture itself.
struct TrainingOptions {
  FeatureKind kind = FeatureKind::kSift;
  double sensitivity = 1;        ///< see FeatureFinder
  std::vector<double> yaws_deg;  ///< about the vertical axis, -75..75
};

/// The yaws that make up for features which bear about 15 degrees: -60, -45, -30, 30, 45, 60.
std::vector<double> wideYaws();

/// Learns `picture` (CV_8U, 1 or 3 channels), which shows the object from the front and nothing else. One
/// without texture leaves an object without features, which is never found. Throws std::invalid_argument
/// naming `label` if a yaw is not allowed.
KnownObject learnObject(const std::string& label, const cv::Mat& picture, const TrainingOptions& options);

/// The database file: magic, version, kind of features, objects. Numbers are little-endian.
std::string encodeObjectDatabase(const ObjectDatabase& database);
/// Throws std::runtime_error "path: byte N: ..." for anything but a whole file of this version.
ObjectDatabase readObjectDatabase(const std::string& path);

/// Objects from `paths`, separated by commas: one database file, or pictures to be learned, each labelled by
/// its file name. Throws std::runtime_error naming the path; std::invalid_argument "objects is ''..." for
/// none.
ObjectDatabase openObjects(const std::string& paths, const TrainingOptions& options);

}  // namespace pomona
