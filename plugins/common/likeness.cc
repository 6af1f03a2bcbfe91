#include "plugins/common/likeness.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "plugins/common/object_place.h"
#include "plugins/common/sift.h"

namespace pomona {
namespace {

constexpr int kLargestSide_px = 96;

cv::Matx33d pictureFromThumbnail(cv::Size picture, cv::Size thumbnail) {
  const double x = static_cast<double>(picture.width) / thumbnail.width,
               y = static_cast<double>(picture.height) / thumbnail.height;
  return {x, 0, 0.5 * x - 0.5, 0, y, 0.5 * y - 0.5, 0, 0, 1};
}

// Pixels of the image per pixel of the thumbnail, in its middle.
double stepOf(const cv::Matx33d& image_from_thumbnail, cv::Size size) {
  const cv::Point2d middle(0.5 * size.width, 0.5 * size.height), at = mapped(image_from_thumbnail, middle);
  const cv::Point2d x = mapped(image_from_thumbnail, middle + cv::Point2d(1, 0)) - at;
  const cv::Point2d y = mapped(image_from_thumbnail, middle + cv::Point2d(0, 1)) - at;
  return std::sqrt(std::abs(x.cross(y)));
}

cv::Rect boxOf(const cv::Matx33d& image_from_thumbnail, cv::Size size) {
  std::vector<cv::Point2f> corners;
  for (const cv::Point2d corner :
       {cv::Point2d(0, 0), cv::Point2d(size.width - 1, 0), cv::Point2d(size.width - 1, size.height - 1),
        cv::Point2d(0, size.height - 1)})
    corners.emplace_back(mapped(image_from_thumbnail, corner));
  constexpr float kFarthest_px = 1e6f;
  for (cv::Point2f& corner : corners)
    corner = {std::clamp(corner.x, -kFarthest_px, kFarthest_px),
              std::clamp(corner.y, -kFarthest_px, kFarthest_px)};
  return cv::boundingRect(corners);
}

double correlation(const cv::Mat& a, const cv::Mat& b, const cv::Mat& mask) {
  cv::Mat x = a - cv::mean(a, mask), y = b - cv::mean(b, mask);
  x.setTo(0, mask == 0);
  y.setTo(0, mask == 0);
  constexpr double kEven = 1;  // gray values
  const double energy = x.dot(x), other = y.dot(y), least = kEven * cv::countNonZero(mask);
  return energy < least || other < least ? -1 : x.dot(y) / std::sqrt(energy * other);
}

}  // namespace

cv::Mat thumbnailOf(const cv::Mat& picture) {
  const double scale = std::min(1.0, double(kLargestSide_px) / std::max(picture.cols, picture.rows));
  const cv::Size size(std::max(1, cvRound(scale * picture.cols)), std::max(1, cvRound(scale * picture.rows)));
  cv::Mat thumbnail;
  cv::resize(grayOf(picture), thumbnail, size, 0, 0, cv::INTER_AREA);
  return thumbnail;
}

double likeness(const cv::Mat& thumbnail, cv::Size picture_size, const cv::Mat& view,
                const cv::Matx33d& image_from_picture) {
  constexpr double kBlur_px = 1;  // of the thumbnail
  const cv::Matx33d image_from_thumbnail =
      image_from_picture * pictureFromThumbnail(picture_size, thumbnail.size());
  const double blur_px = std::max(0.5, kBlur_px * stepOf(image_from_thumbnail, thumbnail.size()));
  const int margin = cvCeil(3 * std::min(blur_px, 1e3));
  const cv::Rect box = boxOf(image_from_thumbnail, thumbnail.size());
  const cv::Rect used = (box + cv::Size(2 * margin, 2 * margin) - cv::Point(margin, margin)) &
                        cv::Rect(0, 0, view.cols, view.rows);
  if (used.empty()) return -1;
  cv::Mat near, seen, inside, known;
  view(used).convertTo(near, CV_32F);
  cv::GaussianBlur(near, near, {}, blur_px);
  const cv::Matx33d used_from_image(1, 0, -used.x, 0, 1, -used.y, 0, 0, 1);
  const cv::Mat map(used_from_image * image_from_thumbnail);
  cv::warpPerspective(near, seen, map, thumbnail.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                      cv::BORDER_REPLICATE);
  cv::warpPerspective(cv::Mat(near.size(), CV_8U, cv::Scalar(255)), inside, map, thumbnail.size(),
                      cv::INTER_NEAREST | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT);
  if (2 * cv::countNonZero(inside) < inside.rows * inside.cols) return -1;
  thumbnail.convertTo(known, CV_32F);
  cv::GaussianBlur(known, known, {}, kBlur_px);
  return correlation(seen, known, inside);
}

}  // namespace pomona
