#include "plugins/common/object_features.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#ifdef POMONA_WITH_SURF
#include "plugins/common/surf/surf.h"
#endif

namespace pomona {
namespace {

struct KindName {
  FeatureKind kind;
  std::string_view name;
};
constexpr KindName kNames[] = {{FeatureKind::kSift, "sift"},
                               {FeatureKind::kRootSift, "root-sift"},
                               {FeatureKind::kSurf64, "surf-64"},
                               {FeatureKind::kSurf128, "surf-128"}};

bool isSurf(FeatureKind kind) {
  return kind == FeatureKind::kSurf64 || kind == FeatureKind::kSurf128;
}

cv::Ptr<cv::Feature2D> surfOf(FeatureKind kind, double sensitivity) {
#ifdef POMONA_WITH_SURF
  SurfOptions options;
  options.hessian_threshold /= static_cast<float>(sensitivity);
  options.extended = kind == FeatureKind::kSurf128;
  return Surf::create(options);
#else
  (void)sensitivity;
  throw std::invalid_argument("features is '" + std::string(nameOf(kind)) + "'; this build is without SURF");
#endif
}

void normalizeRows(cv::Mat& descriptors, FeatureKind kind) {
  for (int i = 0; i < descriptors.rows; ++i) {
    cv::Mat row = descriptors.row(i);
    if (kind == FeatureKind::kRootSift) cv::sqrt(row, row);
    const double length = cv::norm(row);
    if (length > 0) row /= length;
  }
}

}  // namespace

std::string_view nameOf(FeatureKind kind) {
  for (const KindName& known : kNames)
    if (known.kind == kind) return known.name;
  return "unknown";
}

std::vector<FeatureKind> featureKinds() {
#ifdef POMONA_WITH_SURF
  return {FeatureKind::kSift, FeatureKind::kRootSift, FeatureKind::kSurf64, FeatureKind::kSurf128};
#else
  return {FeatureKind::kSift, FeatureKind::kRootSift};
#endif
}

FeatureKind featureKindOf(std::string_view name) {
  std::string allowed;
  for (const FeatureKind kind : featureKinds()) {
    if (nameOf(kind) == name) return kind;
    allowed += (allowed.empty() ? "" : ", ") + std::string(nameOf(kind));
  }
  throw std::invalid_argument("features is '" + std::string(name) + "'; allowed: " + allowed);
}

int descriptorLength(FeatureKind kind) {
  return kind == FeatureKind::kSurf64 ? 64 : 128;
}

FeatureFinder::FeatureFinder(FeatureKind kind, double sensitivity)
    : kind_(kind), sift_{SiftOptions().contrast_threshold / sensitivity, 0} {
  if (isSurf(kind)) surf_ = surfOf(kind, sensitivity);
}

Features FeatureFinder::find(const cv::Mat& image, const cv::Mat& mask) const {
  // What a descriptor sees of its surroundings: enough for all but the coarsest features.
  constexpr int kSurroundings_px = 32;
  Features found;
  cv::Rect area(0, 0, image.cols, image.rows);
  if (!mask.empty()) {
    cv::Rect used = cv::boundingRect(mask);
    if (used.empty()) return found;
    used -= cv::Point(kSurroundings_px, kSurroundings_px);
    used += cv::Size(2 * kSurroundings_px, 2 * kSurroundings_px);
    area &= used;
  }
  const cv::Mat gray = grayOf(image(area)), allowed = mask.empty() ? cv::Mat() : mask(area).clone();
  if (surf_) {
    surf_->detectAndCompute(gray, allowed, found.keypoints, found.descriptors);
  } else {
    const ViewFeatures features = siftFeatures(gray, allowed, sift_);
    found.keypoints = features.keypoints;
    features.descriptors.convertTo(found.descriptors, CV_32F);
  }
  for (cv::KeyPoint& keypoint : found.keypoints) keypoint.pt += cv::Point2f(area.tl());
  normalizeRows(found.descriptors, kind_);
  return found;
}

}  // namespace pomona
