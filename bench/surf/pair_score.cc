#include "bench/surf/pair_score.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace pomona {
namespace {

constexpr double kDiscSigmas = 3, kLeastOverlap = 0.5, kCorrectPx = 3;

struct Disc {
  cv::Point2d centre;
  double radius;
};

cv::Point2d map(const cv::Matx33d& h, cv::Point2d p) {
  const cv::Vec3d q = h * cv::Vec3d(p.x, p.y, 1);
  return {q[0] / q[2], q[1] / q[2]};
}

/// Area ratio of a small patch at `p` and its image: |H| / w^3 for a homography.
double areaScale(const cv::Matx33d& h, cv::Point2d p) {
  const double w = h(2, 0) * p.x + h(2, 1) * p.y + h(2, 2);
  return std::abs(cv::determinant(h) / (w * w * w));
}

double intersectionOverUnion(const Disc& a, const Disc& b) {
  const double d = cv::norm(a.centre - b.centre), r = a.radius, s = b.radius, pi = std::numbers::pi;
  double common = 0;
  if (d <= std::abs(r - s)) {
    common = pi * std::min(r, s) * std::min(r, s);
  } else if (d < r + s) {
    const double u = std::acos((d * d + r * r - s * s) / (2 * d * r));
    const double v = std::acos((d * d + s * s - r * r) / (2 * d * s));
    common = r * r * (u - std::sin(2 * u) / 2) + s * s * (v - std::sin(2 * v) / 2);
  }
  return common / (pi * (r * r + s * s) - common);
}

bool inside(cv::Point2d p, cv::Size size) {
  return p.x >= 0 && p.y >= 0 && p.x <= size.width - 1 && p.y <= size.height - 1;
}

int countCorrespondences(const std::vector<Disc>& first, const std::vector<Disc>& second) {
  struct Pair {
    double overlap;
    std::size_t i, j;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < second.size(); ++j)
      if (const double overlap = intersectionOverUnion(first[i], second[j]); overlap > kLeastOverlap)
        pairs.push_back({overlap, i, j});
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.overlap > b.overlap; });
  std::vector<bool> first_taken(first.size()), second_taken(second.size());
  int count = 0;
  for (const Pair& pair : pairs) {
    if (first_taken[pair.i] || second_taken[pair.j]) continue;
    first_taken[pair.i] = second_taken[pair.j] = true;
    ++count;
  }
  return count;
}

double quotient(int a, int b) {
  return b > 0 ? static_cast<double>(a) / b : 0;
}

}  // namespace

double PairScore::repeatability() const {
  return quotient(correspondences, std::min(first, second));
}
double PairScore::matchingScore() const {
  return quotient(correct, std::min(first, second));
}
double PairScore::precision() const {
  return quotient(correct, matches);
}

Features strongest(cv::Feature2D& method, const cv::Mat& image, int most, float sigma_per_size) {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  method.detectAndCompute(image, cv::noArray(), keypoints, descriptors);
  std::vector<int> order(keypoints.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return keypoints[a].response > keypoints[b].response; });
  if (static_cast<int>(order.size()) > most) order.resize(most);
  Features features;
  for (const int i : order) {
    features.places.push_back(keypoints[i].pt);
    features.sigma_px.push_back(keypoints[i].size * sigma_per_size);
    features.descriptors.push_back(descriptors.row(i));
  }
  return features;
}

PairScore scorePair(const Features& first, const Features& second, const cv::Matx33d& second_from_first,
                    cv::Size second_size, float ratio) {
  const cv::Matx33d first_from_second = second_from_first.inv();
  std::vector<Disc> discs, others;
  for (std::size_t i = 0; i < first.size(); ++i)
    if (const cv::Point2d p = map(second_from_first, first.places[i]); inside(p, second_size))
      discs.push_back(
          {p, kDiscSigmas * first.sigma_px[i] * std::sqrt(areaScale(second_from_first, first.places[i]))});
  for (std::size_t i = 0; i < second.size(); ++i)
    if (inside(map(first_from_second, second.places[i]), second_size))  // the views are of one size
      others.push_back({second.places[i], kDiscSigmas * second.sigma_px[i]});

  PairScore score;
  score.first = static_cast<int>(discs.size());
  score.second = static_cast<int>(others.size());
  score.correspondences = countCorrespondences(discs, others);
  if (first.size() == 0 || second.size() < 2) return score;
  std::vector<std::vector<cv::DMatch>> nearest;
  cv::BFMatcher(cv::NORM_L2).knnMatch(first.descriptors, second.descriptors, nearest, 2);
  for (const auto& two : nearest) {
    if (!(two[0].distance < ratio * two[1].distance)) continue;
    ++score.matches;
    const cv::Point2d expected = map(second_from_first, first.places[two[0].queryIdx]);
    if (cv::norm(expected - cv::Point2d(second.places[two[0].trainIdx])) <= kCorrectPx) ++score.correct;
  }
  return score;
}

}  // namespace pomona
