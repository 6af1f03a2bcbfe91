#include "ripe_fruits.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <opencv2/imgproc.hpp>

namespace {

// Crimson to yellow, not pale and not dark. OpenCV's hue counts 2 degrees; with blue taken for red and red
// for blue, these colours do not lie about its beginning.
cv::Mat ripeMask(const cv::Mat& bgr) {
  cv::Mat hsv, ripe;
  cv::cvtColor(bgr, hsv, cv::COLOR_RGB2HSV);
  cv::inRange(hsv, cv::Scalar(90, 120, 50), cv::Scalar(128, 255, 255), ripe);
  cv::morphologyEx(ripe, ripe, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  return ripe;
}

struct Disc {
  cv::Point center;
  float radius_px;
  float toRim(cv::Point p) const { return static_cast<float>(cv::norm(p - center)) - radius_px; }
};

// The largest discs inside of the mask whose centres lie in none of the others.
std::vector<Disc> discsIn(const cv::Mat& mask) {
  constexpr float kSmallest_px = 2;
  cv::Mat inside_px, largest_px, peaks;
  cv::distanceTransform(mask, inside_px, cv::DIST_L2, cv::DIST_MASK_5);
  cv::dilate(inside_px, largest_px, cv::Mat::ones(5, 5, CV_8U));
  cv::findNonZero((inside_px == largest_px) & (inside_px >= kSmallest_px), peaks);
  std::vector<Disc> candidates, discs;
  for (const cv::Point& peak : cv::Mat_<cv::Point>(peaks))
    candidates.push_back({peak, inside_px.at<float>(peak)});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Disc& a, const Disc& b) { return a.radius_px > b.radius_px; });
  for (const Disc& c : candidates)
    if (std::none_of(discs.begin(), discs.end(), [&](const Disc& d) { return d.toRim(c.center) < 0; }))
      discs.push_back(c);
  return discs;
}

// One part for each disc: what is nearest to its rim.
std::vector<Contour> cut(const Contour& piece) {
  const cv::Rect tight = cv::boundingRect(piece);
  const cv::Rect box(tight.x - 1, tight.y - 1, tight.width + 2,
                     tight.height + 2);  // with a rim that is outside
  cv::Mat1b mask = cv::Mat1b::zeros(box.size());
  cv::fillPoly(mask, std::vector<Contour>{piece}, 255, cv::LINE_8, 0, -box.tl());
  const std::vector<Disc> discs = discsIn(mask);
  if (discs.size() < 2) return {piece};
  cv::Mat1i part_of(mask.size(), -1);
  std::vector<cv::Point> pixels;
  cv::findNonZero(mask, pixels);
  for (const cv::Point& pixel : pixels) {
    const auto nearest = std::min_element(discs.begin(), discs.end(), [&](const Disc& a, const Disc& b) {
      return a.toRim(pixel) < b.toRim(pixel);
    });
    part_of(pixel) = static_cast<int>(nearest - discs.begin());
  }
  std::vector<Contour> parts, contours;
  for (int i = 0; i < static_cast<int>(discs.size()); ++i) {
    cv::findContours(part_of == i, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE, box.tl());
    parts.insert(parts.end(), contours.begin(), contours.end());
  }
  return parts;
}

}  // namespace

// Found at half the size, where it takes a third of the time and still tells where fruits touch.
std::vector<Contour> ripeOutlines(const cv::Mat& bgr) {
  constexpr double kSmallest_px2 = 25;
  cv::Mat half;
  cv::resize(bgr, half, {}, 0.5, 0.5, cv::INTER_AREA);
  const auto isSmall = [](const Contour& contour) { return cv::contourArea(contour) < kSmallest_px2; };
  std::vector<Contour> pieces, outlines;
  cv::findContours(ripeMask(half), pieces, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::erase_if(pieces, isSmall);
  std::vector<std::vector<Contour>> parts(pieces.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(pieces.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) parts[i] = cut(pieces[i]);
  });
  for (const std::vector<Contour>& of_piece : parts)
    std::copy_if(of_piece.begin(), of_piece.end(), std::back_inserter(outlines), std::not_fn(isSmall));
  for (Contour& outline : outlines)
    for (cv::Point& p : outline) p = 2 * p + cv::Point(1, 1);  // pixel p of the half covers 2 p and 2 p + 1
  return outlines;
}
