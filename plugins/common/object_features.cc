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

// Boxes around the parts of `mask`, with what a descriptor sees of its surroundings: enough for all but the
// coarsest features. Those that overlap become one, and so do very many.
std::vector<cv::Rect> areasOf(const cv::Mat& mask) {
  constexpr int kSurroundings_px = 32, kMostAreas = 32;
  cv::Mat labels, figures, middles;
  const int count = cv::connectedComponentsWithStats(mask, labels, figures, middles) - 1;
  std::vector<cv::Rect> areas;
  for (int i = 1; i <= count; ++i) {
    const int* const box = figures.ptr<int>(i);
    const cv::Rect grown(box[cv::CC_STAT_LEFT] - kSurroundings_px, box[cv::CC_STAT_TOP] - kSurroundings_px,
                         box[cv::CC_STAT_WIDTH] + 2 * kSurroundings_px,
                         box[cv::CC_STAT_HEIGHT] + 2 * kSurroundings_px);
    cv::Rect area = grown & cv::Rect(0, 0, mask.cols, mask.rows);
    const auto joins = [&](const cv::Rect& other) { return count > kMostAreas || (other & area).area() > 0; };
    for (auto it = std::find_if(areas.begin(), areas.end(), joins); it != areas.end();
         it = std::find_if(areas.begin(), areas.end(), joins)) {
      area |= *it;
      areas.erase(it);
    }
    areas.push_back(area);
  }
  return areas;
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
  const cv::Rect whole(0, 0, image.cols, image.rows);
  Features found;
  for (const cv::Rect& area : mask.empty() ? std::vector<cv::Rect>{whole} : areasOf(mask)) {
    const cv::Mat gray = grayOf(image(area)), allowed = mask.empty() ? cv::Mat() : mask(area).clone();
    Features part;
    if (surf_) {
      surf_->detectAndCompute(gray, allowed, part.keypoints, part.descriptors);
    } else {
      const ViewFeatures features = siftFeatures(gray, allowed, sift_);
      part.keypoints = features.keypoints;
      features.descriptors.convertTo(part.descriptors, CV_32F);
    }
    if (part.keypoints.empty()) continue;
    for (cv::KeyPoint& keypoint : part.keypoints) keypoint.pt += cv::Point2f(area.tl());
    found.keypoints.insert(found.keypoints.end(), part.keypoints.begin(), part.keypoints.end());
    found.descriptors.push_back(part.descriptors);
  }
  normalizeRows(found.descriptors, kind_);
  return found;
}

}  // namespace pomona
