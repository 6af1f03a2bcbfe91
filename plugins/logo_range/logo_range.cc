#include "plugins/logo_range/logo_range.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "plugins/common/matching.h"
#include "plugins/common/stopwatch.h"
#include "plugins/common/triangulation.h"

namespace pomona {
namespace {

constexpr float kFeatureSigma_px = 0.5f;  // of a disparity between two features

cv::Mat searchMask(const cv::Mat& view, const cv::Mat& mask, bool upper_half) {
  if (!upper_half) return mask;
  cv::Mat upper = cv::Mat::zeros(view.size(), CV_8U);
  upper.rowRange(0, (view.rows + 1) / 2).setTo(255);
  if (!mask.empty()) upper.setTo(0, mask == 0);
  return upper;
}

class SignRanger {
 public:
  SignRanger(const RectifiedPair& pair, const StereoCalibration& rig, const cv::Mat& mask,
             const ObjectDatabase& database, const LogoRangeOptions& options)
      : left_(grayOf(pair.left)),
        right_(grayOf(pair.right)),
        rig_(rig),
        database_(database),
        options_(options),
        finder_(database.kind, options.sensitivity) {
    Stopwatch watch;
    features_ = finder_.find(left_, searchMask(left_, mask, options.upper_half));
    result_.figures.push_back({"features left", double(features_.count()), ""});
    result_.figures.push_back({"feature time", watch.lapMs(), "ms"});
    matches_ = ObjectMatcher(database).match(features_.descriptors);
    view_.matches = matches_;
    result_.figures.push_back({"matching", watch.lapMs(), "ms"});
  }

  SparseResult run() {
    Stopwatch watch;
    for (int i = 0; i < static_cast<int>(database_.objects.size()); ++i) rangeObject(i);
    result_.figures.push_back({"features right", double(right_count_), ""});
    result_.figures.push_back({"ranging", watch.lapMs(), "ms"});
    return std::move(result_);
  }

 private:
  void rangeObject(int number) {
    const KnownObject& known = database_.objects[number];
    SparseObject object;
    object.label = known.label;
    const ObjectPlace place = locateObject(known, number, view_, options_.locate);
    object.why_not = place.why_not;
    if (place.found()) {
      const std::vector<SparsePoint> points = range(number, place, object);
      result_.points.insert(result_.points.end(), points.begin(), points.end());
    }
    result_.objects.push_back(std::move(object));
  }

  std::vector<SparsePoint> range(int number, const ObjectPlace& place, SparseObject& object) {
    if (options_.ranging == ObjectRanging::kMean) {
      std::vector<SparsePoint> points = pointsOn(number, place);
      rangeByMean(points, place, object);
      return points;
    }
    const FlatObject flat{[&](const ObjectPlace& at) { return pointsOn(number, at); },
                          [&](const DisparityPlane& plane) {
                            return locateOnPlane(database_.objects[number], number, view_, plane,
                                                 options_.locate);
                          }};
    return rangeByPlane(left_, right_, rig_, flat, place, object);
  }

  // Features of the left view on the sign: as published those that were recognised; else all inside the
  // outline.
  Features featuresOn(const ObjectPlace& place) const {
    Features on;
    const auto add = [&](int i) {
      on.keypoints.push_back(features_.keypoints[i]);
      on.descriptors.push_back(features_.descriptors.row(i));
    };
    if (options_.ranging == ObjectRanging::kMean) {
      for (const ObjectMatch& match : place.agreeing) add(match.query);
    } else {
      for (int i = 0; i < features_.count(); ++i)
        if (cv::pointPolygonTest(place.outline_px, features_.keypoints[i].pt, false) >= 0) add(i);
    }
    return on;
  }

  // Their partners in the right view, which is searched only where the outline allows them to be.
  std::vector<SparsePoint> pointsOn(int number, const ObjectPlace& place) {
    const RowBand band{static_cast<float>(options_.max_row_offset_px), static_cast<float>(-rig_.doffs_px),
                       static_cast<float>(largestDisparity(rig_, left_))};
    const Features on = featuresOn(place), right = finder_.find(right_, rightMask(place.outline_px, band));
    right_count_ += right.count();
    MatchOptions matching;
    matching.ratio = static_cast<float>(options_.pair_ratio);
    std::vector<SparsePoint> points;
    for (const KeypointMatch& match :
         matchKeypoints(on.descriptors, right.descriptors, matching, band, on.keypoints, right.keypoints)) {
      const SparsePoint point = triangulate(rig_, on.keypoints[match.left].pt,
                                            right.keypoints[match.right].pt, kFeatureSigma_px, number);
      if (std::isfinite(point.point_m.z)) points.push_back(point);
    }
    return points;
  }

  cv::Mat rightMask(const std::vector<cv::Point2f>& outline, const RowBand& band) const {
    const cv::Rect box = cv::boundingRect(outline);
    const int reach = cvCeil(band.max_row_offset_px);
    const int x0 = cvFloor(static_cast<float>(box.x) - band.max_disparity_px);
    const int x1 = cvCeil(static_cast<float>(box.br().x) - band.min_disparity_px);
    const cv::Rect allowed(x0, box.y - reach, x1 - x0, box.height + 2 * reach);
    cv::Mat mask = cv::Mat::zeros(right_.size(), CV_8U);
    mask(allowed & cv::Rect(0, 0, right_.cols, right_.rows)).setTo(255);
    return mask;
  }

  const cv::Mat left_, right_;
  const StereoCalibration& rig_;
  const ObjectDatabase& database_;
  const LogoRangeOptions& options_;
  FeatureFinder finder_;
  Features features_;
  std::vector<ObjectMatch> matches_;
  SeenView view_{left_, features_, {}};
  int right_count_ = 0;
  SparseResult result_;
};

}  // namespace

SparseResult rangeSigns(const RectifiedPair& pair, const StereoCalibration& rig, const cv::Mat& mask,
                        const ObjectDatabase& database, const LogoRangeOptions& options) {
  return SignRanger(pair, rig, mask, database, options).run();
}

}  // namespace pomona
