#include "plugins/logo_range/box_range.h"

#include <algorithm>
#include <cmath>

#include "plugins/common/triangulation.h"
#include "pomona/measure.h"

namespace pomona {
namespace {

cv::Point2f centerOf(const cv::Rect2f& box) {
  return {box.x + box.width / 2, box.y + box.height / 2};
}

void setPoint(const cv::Point3d& point_m, double sigma_m, int support, SparseObject& object) {
  object.point_m = point_m;
  object.distance_m = distanceOf(point_m);
  object.sigma_m = sigma_m;
  object.bearing_deg = bearingOf(point_m);
  object.support = support;
}

// The right view's box that shows the same: of the same class, on the same rows, about as large, not to the
// right of infinity. Of several, the one whose size and row fit best.
const Detection* partnerOf(const Detection& left, const std::vector<Detection>& right, double doffs_px) {
  constexpr float kMostOff = 0.25f;  // of the box's height, for its row; of its area, for its size
  const Detection* best = nullptr;
  float best_off = 2 * kMostOff;
  for (const Detection& other : right) {
    const float row = std::abs(centerOf(other.box_px).y - centerOf(left.box_px).y) / left.box_px.height;
    const float size = std::abs(1 - other.box_px.area() / left.box_px.area());
    const bool in_front = centerOf(left.box_px).x - centerOf(other.box_px).x + doffs_px > 0;
    if (other.kind != left.kind || !in_front || row > kMostOff || size > kMostOff || row + size >= best_off)
      continue;
    best = &other;
    best_off = row + size;
  }
  return best;
}

void rangeByCenters(const Detection& left, const std::vector<Detection>& right, const StereoCalibration& rig,
                    SparseResult& result, SparseObject& object) {
  constexpr float kBoxSigma_px = 1;  // detectors place the edges of boxes to about a pixel, at best
  const Detection* const partner = partnerOf(left, right, rig.doffs_px);
  if (!partner) {
    object.why_not = "the right view has no box to pair it with";
    return;
  }
  const SparsePoint point = triangulate(rig, centerOf(left.box_px), centerOf(partner->box_px), kBoxSigma_px,
                                        static_cast<int>(result.objects.size()));
  result.points.push_back(point);
  const double distance_m = distanceOf(point.point_m);
  setPoint(point.point_m, point.sigma_z_m * distance_m / point.point_m.z, 1, object);
}

void rangeByMap(const Detection& left, const StereoCalibration& rig, const StereoResult& dense,
                SparseObject& object) {
  MeasureOptions options;
  options.shape = ObjectShape::kSurface;
  const cv::Rect box(cvRound(left.box_px.x), cvRound(left.box_px.y), std::max(1, cvRound(left.box_px.width)),
                     std::max(1, cvRound(left.box_px.height)));
  const ObjectMeasurement measured = measureObject(dense, rig, box, options);
  if (!measured.ok()) {
    object.why_not = explain(measured.failure);
    return;
  }
  setPoint(measured.near_point_m, measured.distance_sigma_m, measured.support_px, object);
}

}  // namespace

SparseResult rangeBoxes(const Boxes& boxes, const StereoCalibration& rig, BoxRanging ranging,
                        const std::function<const StereoResult&()>& dense,
                        const std::function<std::string(int)>& label_of) {
  SparseResult result;
  for (const Detection& detection : boxes.left) {
    SparseObject object;
    object.label = label_of(detection.kind);
    object.box_px = detection.box_px;
    if (ranging == BoxRanging::kCenters)
      rangeByCenters(detection, boxes.right, rig, result, object);
    else
      rangeByMap(detection, rig, dense(), object);
    result.objects.push_back(std::move(object));
  }
  return result;
}

}  // namespace pomona
