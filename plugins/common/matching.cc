#include "plugins/common/matching.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>

#include "core/cpu.h"
#include "core/parallel.h"
#include "plugins/common/kernels.h"

namespace pomona {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The nearest candidate; of equally near ones the first.
struct Nearest {
  float distance = kInfinity;
  int index = -1;
};

struct TwoNearest {
  Nearest first;
  float second = kInfinity;

  void offer(float distance, int index) {
    if (distance < first.distance) {
      second = first.distance;
      first = {distance, index};
    } else if (distance < second) {
      second = distance;
    }
  }
};

DistanceWeights weightsOf(DescriptorDistance distance) {
  switch (distance) {
    case DescriptorDistance::kCityblock:
      return {1, 0};
    case DescriptorDistance::kChessboard:
      return {0, 1};
    default:
      return {0.5f, 0.5f};
  }
}

/// Descriptors of one view, in the order of their rows in the image where there is a band.
struct View {
  cv::Mat descriptors;
  std::vector<int> index;           // what they were before they were sorted
  std::vector<cv::Point2f> pixels;  // empty without a band

  int count() const { return descriptors.rows; }
};

View sortedView(const cv::Mat& descriptors, std::span<const cv::KeyPoint> keypoints, bool banded) {
  View view;
  view.index.resize(descriptors.rows);
  std::iota(view.index.begin(), view.index.end(), 0);
  if (!banded) {
    view.descriptors = descriptors.isContinuous() ? descriptors : descriptors.clone();
    return view;
  }
  const auto above = [&](int a, int b) { return keypoints[a].pt.y < keypoints[b].pt.y; };
  std::stable_sort(view.index.begin(), view.index.end(), above);
  view.descriptors.create(descriptors.size(), descriptors.type());
  for (int i = 0; i < view.count(); ++i) {
    const int from = view.index[i];
    std::copy_n(descriptors.ptr(from), descriptors.cols * descriptors.elemSize(), view.descriptors.ptr(i));
    view.pixels.push_back(keypoints[from].pt);
  }
  return view;
}

class Matcher {
 public:
  Matcher(View left, View right, const MatchOptions& options, const RowBand& band)
      : left_(std::move(left)), right_(std::move(right)), options_(options), band_(band) {}

  std::vector<KeypointMatch> run() {
    const int threads = options_.threads > 0 ? options_.threads : availableThreads();
    const int parts = std::clamp(left_.count() / kFewestPerPart, 1, 2 * threads);
    best_.resize(left_.count());
    std::vector<std::vector<Nearest>> back(parts);
    parallelFor(threads, parts, [&](int part) {
      if (options_.mutual) back[part].resize(right_.count());
      const auto edge = [&](int k) { return static_cast<int>(std::int64_t{left_.count()} * k / parts); };
      for (int begin = edge(part); begin < edge(part + 1); begin += kQueryBlock)
        compareBlock(begin, std::min(begin + kQueryBlock, edge(part + 1)), back[part]);
    });
    return accepted(merged(back));
  }

 private:
  // A block of queries meets a block of candidates while that is in the cache.
  static constexpr int kQueryBlock = 64, kCandidateBlock = 256, kFewestPerPart = 128;

  struct Range {
    int begin, end;
  };

  /// The right keypoints in the rows that the band allows, or all of them.
  Range candidatesOf(int left) const {
    if (right_.pixels.empty()) return {0, right_.count()};
    const float y = left_.pixels[left].y;
    const auto first = std::partition_point(right_.pixels.begin(), right_.pixels.end(), [&](cv::Point2f p) {
      return p.y - y < -band_.max_row_offset_px;
    });
    const auto last = std::partition_point(first, right_.pixels.end(),
                                           [&](cv::Point2f p) { return p.y - y <= band_.max_row_offset_px; });
    return {static_cast<int>(first - right_.pixels.begin()), static_cast<int>(last - right_.pixels.begin())};
  }

  void compareBlock(int begin, int end, std::vector<Nearest>& back) {
    Range all{right_.count(), 0}, range[kQueryBlock];
    for (int i = begin; i < end; ++i) {
      range[i - begin] = candidatesOf(i);
      all.begin = std::min(all.begin, range[i - begin].begin);
      all.end = std::max(all.end, range[i - begin].end);
    }
    for (int block = all.begin; block < all.end; block += kCandidateBlock)
      for (int i = begin; i < end; ++i) {
        const Range r = range[i - begin];
        compare(i, {std::max(r.begin, block), std::min(r.end, block + kCandidateBlock)}, back);
      }
  }

  void compare(int left, Range range, std::vector<Nearest>& back) {
    if (range.begin >= range.end) return;
    float distance[kCandidateBlock];
    distances(left, range, distance);
    TwoNearest& best = best_[left];
    for (int j = range.begin; j < range.end; ++j) {
      const float d = distance[j - range.begin];
      const bool nearer = d < best.second, nearer_back = options_.mutual && d < back[j].distance;
      if (!(nearer || nearer_back)) continue;  // nearly always
      if (!right_.pixels.empty() && !band_.allows(left_.pixels[left], right_.pixels[j])) continue;
      if (nearer) best.offer(d, j);
      if (nearer_back) back[j] = {d, left};
    }
  }

  void distances(int left, Range range, float* out) const {
    const int length = left_.descriptors.cols, count = range.end - range.begin;
    const bool euclidean = options_.distance == DescriptorDistance::kEuclidean;
    const DistanceWeights weights = weightsOf(options_.distance);
    if (left_.descriptors.type() == CV_8UC1) {
      const auto* query = left_.descriptors.ptr(left);
      const auto* others = right_.descriptors.ptr(range.begin);
      euclidean ? kernels_.squaredEuclid8(query, others, length, count, out)
                : kernels_.weighted8(query, others, length, count, weights, out);
    } else {
      const auto* query = left_.descriptors.ptr<float>(left);
      const auto* others = right_.descriptors.ptr<float>(range.begin);
      euclidean ? kernels_.squaredEuclid32(query, others, length, count, out)
                : kernels_.weighted32(query, others, length, count, weights, out);
    }
  }

  /// The parts are in the order of the left keypoints, so the first of equally near ones stays the first.
  static std::vector<Nearest> merged(std::vector<std::vector<Nearest>>& parts) {
    std::vector<Nearest> all = std::move(parts.front());
    for (std::size_t part = 1; part < parts.size(); ++part)
      for (std::size_t j = 0; j < all.size(); ++j)
        if (parts[part][j].distance < all[j].distance) all[j] = parts[part][j];
    return all;
  }

  std::vector<KeypointMatch> accepted(const std::vector<Nearest>& back) const {
    const bool squared = options_.distance == DescriptorDistance::kEuclidean;
    const auto root = [&](float d) { return squared ? std::sqrt(d) : d; };
    std::vector<KeypointMatch> matches;
    for (int i = 0; i < left_.count(); ++i) {
      const Nearest first = best_[i].first;
      if (first.index < 0 || (options_.mutual && back[first.index].index != i)) continue;
      const float distance = root(first.distance), second = root(best_[i].second);
      const bool distinct = options_.ratio >= 1 || distance < options_.ratio * second;
      if (!distinct || !(distance <= options_.max_distance)) continue;
      const float ratio = std::isinf(second) ? 0 : second > 0 ? distance / second : 1;
      matches.push_back({left_.index[i], right_.index[first.index], distance, ratio});
    }
    std::sort(matches.begin(), matches.end(), [](const auto& a, const auto& b) { return a.left < b.left; });
    return matches;
  }

  View left_, right_;
  const MatchOptions& options_;
  const RowBand& band_;
  const DistanceKernels& kernels_ = distanceKernels(chooseIsa(""));
  std::vector<TwoNearest> best_;
};

void requireDescriptors(const cv::Mat& left, const cv::Mat& right) {
  const bool known = left.type() == CV_8UC1 || left.type() == CV_32FC1;
  if (!known || right.type() != left.type() || right.cols != left.cols)
    throw std::invalid_argument("descriptors are " + cv::typeToString(left.type()) + " of " +
                                std::to_string(left.cols) + " and " + cv::typeToString(right.type()) +
                                " of " + std::to_string(right.cols) +
                                " values; allowed: CV_8UC1 or CV_32FC1, the same for both");
}

}  // namespace

bool RowBand::allows(cv::Point2f left_px, cv::Point2f right_px) const {
  const float disparity_px = left_px.x - right_px.x;
  return std::abs(left_px.y - right_px.y) <= max_row_offset_px && min_disparity_px <= disparity_px &&
         disparity_px <= max_disparity_px;
}

std::vector<KeypointMatch> matchKeypoints(const cv::Mat& left, const cv::Mat& right,
                                          const MatchOptions& options, const RowBand& band,
                                          std::span<const cv::KeyPoint> left_keypoints,
                                          std::span<const cv::KeyPoint> right_keypoints) {
  if (left.empty() || right.empty()) return {};
  requireDescriptors(left, right);
  const bool banded = band.max_row_offset_px < RowBand::kAny || band.min_disparity_px > -RowBand::kAny ||
                      band.max_disparity_px < RowBand::kAny;
  const auto fits = [](std::span<const cv::KeyPoint> keypoints, const cv::Mat& descriptors) {
    return static_cast<int>(keypoints.size()) == descriptors.rows;
  };
  if (banded && (!fits(left_keypoints, left) || !fits(right_keypoints, right)))
    throw std::invalid_argument("keypoints: " + std::to_string(left_keypoints.size()) + " and " +
                                std::to_string(right_keypoints.size()) +
                                "; allowed: as many as descriptors, " + std::to_string(left.rows) + " and " +
                                std::to_string(right.rows));
  return Matcher(sortedView(left, left_keypoints, banded), sortedView(right, right_keypoints, banded),
                 options, band)
      .run();
}

cv::Mat descriptorsToBytes(const cv::Mat& descriptors, double scale) {
  cv::Mat bytes;
  descriptors.convertTo(bytes, CV_8U, scale);
  return bytes;
}

}  // namespace pomona
