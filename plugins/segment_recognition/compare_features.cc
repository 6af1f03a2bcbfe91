#include <cmath>

#include "plugins/common/epipolar.h"
#include "plugins/common/stopwatch.h"
#include "plugins/common/triangulation.h"
#include "plugins/segment_recognition/recognition.h"

namespace pomona {
namespace {

constexpr float kFeatureSigma_px = 0.5f;  // of a disparity between two features

class Comparison {
 public:
  Comparison(const RectifiedPair& pair, const StereoCalibration& rig, const cv::Mat& mask,
             const std::function<const StereoResult&()>& dense, FeatureKind kind,
             const RecognitionOptions& options)
      : left_(grayOf(pair.left)),
        right_(grayOf(pair.right)),
        rig_(rig),
        mask_(mask),
        dense_(dense),
        options_(options),
        finder_(kind, options.sensitivity) {}

  ComparedFeatures run(const ObjectMatcher& matcher) {
    if (options_.filter == FeatureFilter::kDisparity) findRegions();
    result_.figures.push_back({"regions", watch_.lapMs(), "ms"});
    const Features left = finder_.find(left_, mask_);
    if (usesMap()) {
      countFeatures(left.count());
      for (int i = 0; i < left.count(); ++i) addByMap(left, i);
    } else {
      const Features right = finder_.find(right_, right_mask_);
      countFeatures(left.count() + right.count());
      addPaired(left, right);
    }
    result_.matches = matcher.match(result_.features.descriptors);
    result_.figures.push_back({"matching", watch_.lapMs(), "ms"});
    return std::move(result_);
  }

 private:
  bool usesMap() const {
    return options_.filter == FeatureFilter::kDisparity && options_.disparity == FeatureDisparity::kMap;
  }

  void countFeatures(int count) {
    result_.figures.push_back({"features", static_cast<double>(count), ""});
    result_.figures.push_back({"feature time", watch_.lapMs(), "ms"});
  }

  void findRegions() {
    const cv::Mat map = options_.engine_map || usesMap()
                            ? dense_().disparity
                            : blockMatchingDisparity(left_, right_, cvCeil(largestDisparity(rig_, left_)));
    cv::Mat regions = nearRegions(map, rig_, options_.regions);
    if (!mask_.empty()) regions.setTo(0, mask_ == 0);
    if (!usesMap()) right_mask_ = regionsInRightView(regions, map, options_.regions);
    mask_ = regions;
  }

  void addByMap(const Features& left, int i) {
    const StereoResult& map = dense_();
    const cv::Point2f at = left.keypoints[i].pt;
    const cv::Point pixel(cvRound(at.x), cvRound(at.y));
    const float d = map.disparity.at<float>(pixel);
    const float sigma_px = map.sigma_px.empty() ? kFeatureSigma_px : map.sigma_px.at<float>(pixel);
    if (std::isfinite(d)) add(left, i, triangulate(rig_, at, at - cv::Point2f(d, 0), sigma_px));
  }

  // As published: the most similar feature of the whole right view, then what the geometry says about it.
  void addPaired(const Features& left, const Features& right) {
    MatchOptions matching;
    matching.ratio = static_cast<float>(options_.pair_ratio);
    const cv::Matx33d fundamental = fundamentalMatrix(rig_);
    for (const KeypointMatch& match : matchKeypoints(left.descriptors, right.descriptors, matching)) {
      const cv::Point2f at = left.keypoints[match.left].pt, partner = right.keypoints[match.right].pt;
      const SparsePoint point = triangulate(rig_, at, partner, kFeatureSigma_px);
      const bool possible = std::isfinite(point.point_m.z) &&
                            epipolarDistance(fundamental, at, partner) <= options_.max_epipolar_px;
      if (options_.filter == FeatureFilter::kNone || possible) add(left, match.left, point);
    }
  }

  void add(const Features& left, int i, const SparsePoint& point) {
    result_.features.keypoints.push_back(left.keypoints[i]);
    result_.features.descriptors.push_back(left.descriptors.row(i));
    result_.points.push_back(point);
  }

  const cv::Mat left_, right_;
  const StereoCalibration& rig_;
  cv::Mat mask_, right_mask_;
  const std::function<const StereoResult&()>& dense_;
  const RecognitionOptions& options_;
  FeatureFinder finder_;
  Stopwatch watch_;
  ComparedFeatures result_;
};

}  // namespace

ComparedFeatures compareFeatures(const RectifiedPair& pair, const StereoCalibration& rig, const cv::Mat& mask,
                                 const std::function<const StereoResult&()>& dense,
                                 const ObjectMatcher& matcher, const RecognitionOptions& options) {
  return Comparison(pair, rig, mask, dense, matcher.kind(), options).run(matcher);
}

}  // namespace pomona
