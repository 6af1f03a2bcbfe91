#include "plugins/segment_recognition/recognition.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace pomona {
namespace {

// The points of the matches that agree on the object's place, as its own.
std::vector<SparsePoint> pointsOf(int number, const ObjectPlace& place, const ComparedFeatures& compared) {
  std::vector<SparsePoint> points;
  for (const ObjectMatch& match : place.agreeing) {
    SparsePoint point = compared.points[match.query];
    point.object = number;
    if (std::isfinite(point.point_m.z)) points.push_back(point);
  }
  return points;
}

}  // namespace

SparseResult recogniseObjects(const RectifiedPair& pair, const StereoCalibration& rig, const cv::Mat& mask,
                              const std::function<const StereoResult&()>& dense,
                              const ObjectDatabase& database, const RecognitionOptions& options) {
  const ObjectMatcher matcher(database);
  const ComparedFeatures compared = compareFeatures(pair, rig, mask, dense, matcher, options);
  const cv::Mat left = grayOf(pair.left), right = grayOf(pair.right);
  SparseResult result;
  result.figures = compared.figures;
  for (int i = 0; i < static_cast<int>(database.objects.size()); ++i) {
    const KnownObject& known = database.objects[i];
    const ObjectPlace place =
        locateObject(known, i, compared.features.keypoints, compared.matches, options.locate);
    SparseObject object;
    object.label = known.label;
    object.why_not = place.why_not;
    if (place.found()) {
      object.outline_px = place.outline_px;
      object.box_px = cv::boundingRect(place.outline_px);
      const std::vector<SparsePoint> points = pointsOf(i, place, compared);
      result.points.insert(result.points.end(), points.begin(), points.end());
      const cv::Point2d middle((known.size_px.width - 1) / 2.0, (known.size_px.height - 1) / 2.0);
      if (options.ranging == ObjectRanging::kMean)
        rangeByMean(points, object);
      else
        rangeByPlane(left, right, rig, points, mapped(place.image_from_picture, middle), object);
    }
    result.objects.push_back(std::move(object));
  }
  return result;
}

}  // namespace pomona
