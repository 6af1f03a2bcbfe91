// Window matching as the papers have it: every window of every pixel and disparity, summed anew, in double.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

namespace pomona::reference {

/// cost[y][x][i] of the disparity min + i; infinite where the match lies outside the right view.
using CostVolume = std::vector<std::vector<std::vector<double>>>;

template <typename Cost>
CostVolume costVolume(int width, int height, int min, int count, Cost cost) {
  CostVolume volume(static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::vector<double> costs;
      for (int d = min; d < min + count; ++d)
        costs.push_back(x - d < 0 || x - d >= width ? std::numeric_limits<double>::infinity()
                                                    : cost(y, x, d));
      volume[static_cast<std::size_t>(y)].push_back(costs);
    }
  return volume;
}

/// Channel c of the pixel nearest to (y, x).
inline double valueAt(const cv::Mat& image, int y, int x, int c) {
  y = std::clamp(y, 0, image.rows - 1);
  x = std::clamp(x, 0, image.cols - 1);
  const int at = x * image.channels() + std::min(c, image.channels() - 1);
  return image.depth() == CV_8U ? image.ptr<std::uint8_t>(y)[at] : image.ptr<std::uint16_t>(y)[at];
}

inline double ssd(const cv::Mat& left, const cv::Mat& right, int radius, int y, int x, int d) {
  double sum = 0;
  for (int v = -radius; v <= radius; ++v)
    for (int u = -radius; u <= radius; ++u)
      for (int c = 0; c < left.channels(); ++c) {
        const double difference = valueAt(left, y + v, x + u, c) - valueAt(right, y + v, x - d + u, c);
        sum += difference * difference;
      }
  return sum;
}

/// 1 - correlation; 1 if a window has no texture.
inline double ncc(const cv::Mat& left, const cv::Mat& right, int radius, int y, int x, int d) {
  double covariance = 0, left_variance = 0, right_variance = 0;
  for (int c = 0; c < left.channels(); ++c) {
    std::vector<double> l, r;
    for (int v = -radius; v <= radius; ++v)
      for (int u = -radius; u <= radius; ++u) {
        l.push_back(valueAt(left, y + v, x + u, c));
        r.push_back(valueAt(right, y + v, x - d + u, c));
      }
    double l_mean = 0, r_mean = 0;
    for (std::size_t i = 0; i < l.size(); ++i) {
      l_mean += l[i] / static_cast<double>(l.size());
      r_mean += r[i] / static_cast<double>(l.size());
    }
    for (std::size_t i = 0; i < l.size(); ++i) {
      covariance += (l[i] - l_mean) * (r[i] - r_mean);
      left_variance += (l[i] - l_mean) * (l[i] - l_mean);
      right_variance += (r[i] - r_mean) * (r[i] - r_mean);
    }
  }
  const bool textured = left_variance > 1e-6 && right_variance > 1e-6;
  return 1 - (textured ? covariance / std::sqrt(left_variance * right_variance) : 0);
}

struct AswParameters {
  int radius;
  double color_gamma, proximity_gamma, truncation;
};

/// `lab_left`, `lab_right`: CV_64FC3. Colours are in 8-bit units, times `scale`.
inline double asw(const cv::Mat& left, const cv::Mat& right, const cv::Mat& lab_left,
                  const cv::Mat& lab_right, double scale, const AswParameters& p, int y, int x, int d) {
  const auto support = [&](const cv::Mat& lab, int centre, int v, int u) {
    const double color = cv::norm(lab.at<cv::Vec3d>(y, centre) - lab.at<cv::Vec3d>(y + v, centre + u));
    return std::exp(-color / p.color_gamma - std::sqrt(u * u + v * v) / p.proximity_gamma);
  };
  double sum = 0, weights = 0;
  for (int v = -p.radius; v <= p.radius; ++v)
    for (int u = -p.radius; u <= p.radius; ++u) {
      const bool inside = y + v >= 0 && y + v < left.rows && x + u >= 0 && x + u < left.cols &&
                          x - d + u >= 0 && x - d + u < left.cols;
      if (!inside) continue;
      double raw = 0;
      for (int c = 0; c < 3; ++c)
        raw += scale * std::abs(valueAt(left, y + v, x + u, c) - valueAt(right, y + v, x - d + u, c));
      const double weight = support(lab_left, x, v, u) * support(lab_right, x - d, v, u);
      sum += weight * std::min(raw, p.truncation);
      weights += weight;
    }
  return sum / weights;
}

}  // namespace pomona::reference
