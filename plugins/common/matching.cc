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
      : left_(std::move(left)),
        right_(std::move(right)),
        options_(options),
        band_(band),
        best_(static_cast<std::size_t>(left_.count())) {}

  std::vector<KeypointMatch> run() {
    inParts(left_.count(), [&](int begin, int end) {
      for (; begin < end; begin += kQueryBlock) compareBlock(begin, std::min(begin + kQueryBlock, end));
    });
    return accepted();
  }

 private:
  // A block of queries meets a block of candidates while that is in the cache.
  static constexpr int kQueryBlock = 64, kCandidateBlock = 256, kFewestPerPart = 128;

  struct Range {
    int begin, end;
  };

  /// Calls work(begin, end) for parts of [0, count), in threads.
  template <typename Work>
  void inParts(int count, Work work) const {
    const int threads = options_.threads > 0 ? options_.threads : availableThreads();
    const int parts = std::clamp(count / kFewestPerPart, 1, 2 * threads);
    const auto edge = [&](int k) { return static_cast<int>(std::int64_t{count} * k / parts); };
    parallelFor(threads, parts, [&](int part) { work(edge(part), edge(part + 1)); });
  }

  /// The keypoints of `other` in the rows that the band allows for number `i` of `view`, or all of them.
  Range candidatesOf(const View& view, int i, const View& other) const {
    if (other.pixels.empty()) return {0, other.count()};
    const float y = view.pixels[i].y;
    const auto first = std::partition_point(other.pixels.begin(), other.pixels.end(), [&](cv::Point2f p) {
      return p.y - y < -band_.max_row_offset_px;
    });
    const auto last = std::partition_point(first, other.pixels.end(),
                                           [&](cv::Point2f p) { return p.y - y <= band_.max_row_offset_px; });
    return {static_cast<int>(first - other.pixels.begin()), static_cast<int>(last - other.pixels.begin())};
  }

  bool allows(int left, int right) const {
    return right_.pixels.empty() || band_.allows(left_.pixels[left], right_.pixels[right]);
  }

  void compareBlock(int begin, int end) {
    Range all{right_.count(), 0}, range[kQueryBlock];
    for (int i = begin; i < end; ++i) {
      range[i - begin] = candidatesOf(left_, i, right_);
      all.begin = std::min(all.begin, range[i - begin].begin);
      all.end = std::max(all.end, range[i - begin].end);
    }
    for (int block = all.begin; block < all.end; block += kCandidateBlock)
      for (int i = begin; i < end; ++i) {
        const Range r = range[i - begin];
        compare(i, {std::max(r.begin, block), std::min(r.end, block + kCandidateBlock)});
      }
  }

  void compare(int left, Range range) {
    if (range.begin >= range.end) return;
    float distance[kCandidateBlock];
    TwoNearest& best = best_[left];
    distances(left_, left, right_, range, best.second, distance);
    for (int j = range.begin; j < range.end; ++j)
      if (const float d = distance[j - range.begin]; d < best.second && allows(left, j)) best.offer(d, j);
  }

  /// Whether no other left descriptor is nearer to the right one than `left` at `distance`, nor as near and
  /// before it.
  bool isNearestBack(int left, int right, float distance) const {
    const float limit = std::nextafter(distance, kInfinity);
    const Range all = candidatesOf(right_, right, left_);
    float back[kCandidateBlock];
    for (int begin = all.begin; begin < all.end; begin += kCandidateBlock) {
      const Range range{begin, std::min(all.end, begin + kCandidateBlock)};
      distances(right_, right, left_, range, limit, back);
      for (int i = range.begin; i < range.end; ++i)
        if (const float d = back[i - range.begin];
            (d < distance || (d == distance && i < left)) && allows(i, right))
          return false;
    }
    return true;
  }

  /// Those of `limit` or more may be too small, but no smaller than that.
  void distances(const View& view, int i, const View& others, Range range, float limit, float* out) const {
    const int length = view.descriptors.cols, count = range.end - range.begin;
    const bool euclidean = options_.distance == DescriptorDistance::kEuclidean;
    const DistanceWeights weights = weightsOf(options_.distance);
    if (view.descriptors.type() == CV_8UC1) {
      const auto* query = view.descriptors.ptr(i);
      const auto* candidates = others.descriptors.ptr(range.begin);
      euclidean ? kernels_.squaredEuclid8(query, candidates, length, count, limit, out)
                : kernels_.weighted8(query, candidates, length, count, weights, limit, out);
    } else {
      const auto* query = view.descriptors.ptr<float>(i);
      const auto* candidates = others.descriptors.ptr<float>(range.begin);
      euclidean ? kernels_.squaredEuclid32(query, candidates, length, count, out)
                : kernels_.weighted32(query, candidates, length, count, weights, out);
    }
  }

  /// Whether the nearest of `left` is near and distinct enough.
  bool passes(int left) const {
    const float distance = root(best_[left].first.distance), second = root(best_[left].second);
    return best_[left].first.index >= 0 && (options_.ratio >= 1 || distance < options_.ratio * second) &&
           distance <= options_.max_distance;
  }

  float root(float distance) const {
    return options_.distance == DescriptorDistance::kEuclidean ? std::sqrt(distance) : distance;
  }

  std::vector<KeypointMatch> accepted() const {
    std::vector<std::uint8_t> accepts(left_.count());
    inParts(left_.count(), [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const Nearest& first = best_[i].first;
        accepts[i] = passes(i) && (!options_.mutual || isNearestBack(i, first.index, first.distance));
      }
    });
    std::vector<KeypointMatch> matches;
    for (int i = 0; i < left_.count(); ++i) {
      if (!accepts[i]) continue;
      const Nearest& first = best_[i].first;
      const float distance = root(first.distance), second = root(best_[i].second);
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
