#include "plugins/segment_recognition/recognition.h"

#include <cmath>

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

// The views, and what was recognised in them.
struct Recognised {
  cv::Mat left, right;
  const StereoCalibration& rig;
  const ComparedFeatures& compared;
  const RecognitionOptions& options;

  SeenView view() const { return {left, compared.features, compared.matches}; }
};

std::vector<SparsePoint> range(const Recognised& seen, const KnownObject& known, int number,
                               const ObjectPlace& place, SparseObject& object) {
  const FlatObject flat{[&](const ObjectPlace& at) { return pointsOf(number, at, seen.compared); },
                        [&](const DisparityPlane& plane) {
                          return locateOnPlane(known, number, seen.view(), plane, seen.options.locate);
                        }};
  if (seen.options.ranging == ObjectRanging::kPlane)
    return rangeByPlane(seen.left, seen.right, seen.rig, flat, place, object);
  std::vector<SparsePoint> points = flat.points_at(place);
  rangeByMean(points, place, object);
  return points;
}

}  // namespace

SparseResult recogniseObjects(const RectifiedPair& pair, const StereoCalibration& rig, const cv::Mat& mask,
                              const std::function<const StereoResult&()>& dense,
                              const ObjectDatabase& database, const RecognitionOptions& options) {
  const ObjectMatcher matcher(database);
  const ComparedFeatures compared = compareFeatures(pair, rig, mask, dense, matcher, options);
  const Recognised seen{grayOf(pair.left), grayOf(pair.right), rig, compared, options};
  SparseResult result;
  result.figures = compared.figures;
  for (int i = 0; i < static_cast<int>(database.objects.size()); ++i) {
    const KnownObject& known = database.objects[i];
    const ObjectPlace place = locateObject(known, i, seen.view(), options.locate);
    SparseObject object;
    object.label = known.label;
    object.why_not = place.why_not;
    if (place.found()) {
      const std::vector<SparsePoint> points = range(seen, known, i, place, object);
      result.points.insert(result.points.end(), points.begin(), points.end());
    }
    result.objects.push_back(std::move(object));
  }
  return result;
}

}  // namespace pomona
