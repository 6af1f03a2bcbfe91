#include "picking_list.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ripe_fruits.h"

namespace {

// Whether `other` is a piece of `fruit`: two fruits that touch have their centres two radii apart, pieces
// about none, but small ones lie unsurely.
bool isPieceOf(const Pick& fruit, const Pick& other) {
  if (!fruit.where.ok()) return false;
  if (!other.where.ok()) return fruit.box.contains((other.box.tl() + other.box.br()) / 2);
  return cv::norm(fruit.where.center_m - other.where.center_m) <
         (fruit.where.radius_m + other.where.radius_m) / 2 + other.where.center_sigma_m;
}

cv::Rect boxOf(const pomona::ObjectMeasurement& fruit, const pomona::StereoCalibration& c) {
  const double scale = c.focal_px / fruit.center_m[2], radius_px = scale * fruit.radius_m;
  return cv::Rect2d(c.cx_px + scale * fruit.center_m[0] - radius_px,
                    c.cy_px + scale * fruit.center_m[1] - radius_px, 2 * radius_px, 2 * radius_px);
}

}  // namespace

// Fruits that leaves divide come in pieces: the one that shows most of it is kept, and pieces that are too
// small to be measured are left out where a fruit is known.
std::vector<Pick> pickingList(const pomona::StereoResult& result,
                              const pomona::StereoCalibration& calibration, const cv::Mat& bgr) {
  pomona::MeasureOptions apples;
  apples.radius_m = 0.038;
  apples.radius_sigma_m = 0.006;
  const std::vector<Contour> outlines = ripeOutlines(bgr);
  std::vector<Pick> picks(outlines.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(picks.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      const pomona::Polygon outline(outlines[i].begin(), outlines[i].end());
      picks[i] = {cv::boundingRect(outlines[i]), pomona::measureObject(result, calibration, outline, apples)};
      if (picks[i].where.ok()) picks[i].box = boxOf(picks[i].where, calibration) & cv::Rect({}, bgr.size());
    }
  });
  // Measured ones first, by what is seen of them; then each against those before it.
  std::sort(picks.begin(), picks.end(), [](const Pick& a, const Pick& b) {
    return std::pair(!a.where.ok(), -a.where.support_px) < std::pair(!b.where.ok(), -b.where.support_px);
  });
  std::vector<Pick> fruits;
  for (const Pick& pick : picks)
    if (std::none_of(fruits.begin(), fruits.end(), [&](const Pick& f) { return isPieceOf(f, pick); }))
      fruits.push_back(pick);
  std::stable_sort(fruits.begin(), fruits.end(), [](const Pick& a, const Pick& b) {
    return a.where.ok() && b.where.ok() && a.where.distance_m < b.where.distance_m;
  });
  return fruits;
}
