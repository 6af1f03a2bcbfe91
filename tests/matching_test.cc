#include "plugins/common/matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/cpu.h"
#include "plugins/common/kernels.h"

namespace pomona {
namespace {

cv::Mat randomDescriptors(int count, int length, int type, unsigned seed) {
  cv::Mat descriptors(count, length, type);
  cv::RNG(seed).fill(descriptors, cv::RNG::UNIFORM, 0, 256);
  return descriptors;
}

double valueAt(const cv::Mat& m, int y, int x) {
  return m.type() == CV_8U ? m.at<std::uint8_t>(y, x) : m.at<float>(y, x);
}

/// The textbook: every value one after the other.
double slowDistance(const cv::Mat& a, int i, const cv::Mat& b, int j, DescriptorDistance distance) {
  double squares = 0, sum = 0, largest = 0;
  for (int k = 0; k < a.cols; ++k) {
    const double difference = std::abs(valueAt(a, i, k) - valueAt(b, j, k));
    squares += difference * difference;
    sum += difference;
    largest = std::max(largest, difference);
  }
  switch (distance) {
    case DescriptorDistance::kEuclidean:
      return std::sqrt(squares);
    case DescriptorDistance::kCityblock:
      return sum;
    case DescriptorDistance::kChessboard:
      return largest;
    default:
      return 0.5 * sum + 0.5 * largest;
  }
}

struct SlowMatcher {
  const cv::Mat &left, &right;
  const MatchOptions& options;
  const RowBand& band;
  const std::vector<cv::KeyPoint>&left_keypoints, &right_keypoints;

  double distance(int i, int j) const {
    if (!left_keypoints.empty() && !band.allows(left_keypoints[i].pt, right_keypoints[j].pt)) return INFINITY;
    return slowDistance(left, i, right, j, options.distance);
  }

  std::vector<KeypointMatch> run() const {
    std::vector<KeypointMatch> matches;
    for (int i = 0; i < left.rows; ++i) {
      std::vector<std::pair<double, int>> order;
      for (int j = 0; j < right.rows; ++j) order.emplace_back(distance(i, j), j);
      std::sort(order.begin(), order.end());
      const auto [best, j] = order[0];
      const double second = order.size() > 1 ? order[1].first : INFINITY;
      if (std::isinf(best) || best > options.max_distance) continue;
      if (options.ratio < 1 && !(best < options.ratio * second)) continue;
      bool nearest_back = true;
      for (int k = 0; k < left.rows; ++k) nearest_back &= distance(k, j) >= best;
      if (options.mutual && !nearest_back) continue;
      matches.push_back({i, j, static_cast<float>(best), static_cast<float>(best / second)});
    }
    return matches;
  }
};

std::vector<cv::KeyPoint> randomKeypoints(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> quarter(0, 400);
  std::vector<cv::KeyPoint> keypoints;
  for (int i = 0; i < count; ++i)
    keypoints.emplace_back(quarter(random) / 4.0f, quarter(random) / 4.0f, 1.0f);
  return keypoints;
}

void expectEqual(const std::vector<KeypointMatch>& matches, const std::vector<KeypointMatch>& expected) {
  ASSERT_EQ(matches.size(), expected.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    EXPECT_EQ(matches[i].left, expected[i].left);
    EXPECT_EQ(matches[i].right, expected[i].right);
    EXPECT_NEAR(matches[i].distance, expected[i].distance, 1e-5f * expected[i].distance);
    EXPECT_NEAR(matches[i].ratio, expected[i].ratio, 1e-5f);
  }
}

constexpr DescriptorDistance kAll[] = {DescriptorDistance::kEuclidean, DescriptorDistance::kCityblock,
                                       DescriptorDistance::kChessboard, DescriptorDistance::kCombined};

TEST(Matching, KernelsAreTheTextbookOnEveryInstructionSet) {
  for (const Isa isa : usableIsas())
    for (const int length : {1, 7, 31, 33, 64, 65, 128, 200})
      for (const int type : {CV_8U, CV_32F})
        for (const DescriptorDistance distance : kAll) {
          SCOPED_TRACE(testing::Message() << name(isa) << " length " << length << " type " << type
                                          << " distance " << static_cast<int>(distance));
          cv::Mat a = randomDescriptors(1, length, type, 1), b = randomDescriptors(9, length, type, 2);
          a.setTo(255);  // the extremes, too
          b.row(8).setTo(0);
          const DistanceKernels& kernels = distanceKernels(isa);
          const DistanceWeights weights = distance == DescriptorDistance::kCityblock ? DistanceWeights{1, 0}
                                          : distance == DescriptorDistance::kChessboard
                                              ? DistanceWeights{0, 1}
                                              : DistanceWeights{0.5f, 0.5f};
          const bool euclidean = distance == DescriptorDistance::kEuclidean;
          std::vector<float> out(9);
          const auto run_bytes = [&](float limit, std::vector<float>& to) {
            euclidean ? kernels.squaredEuclid8(a.ptr(), b.ptr(), length, 9, limit, to.data())
                      : kernels.weighted8(a.ptr(), b.ptr(), length, 9, weights, limit, to.data());
          };
          if (type == CV_8U) run_bytes(INFINITY, out);
          if (type == CV_32F && euclidean)
            kernels.squaredEuclid32(a.ptr<float>(), b.ptr<float>(), length, 9, out.data());
          if (type == CV_32F && !euclidean)
            kernels.weighted32(a.ptr<float>(), b.ptr<float>(), length, 9, weights, out.data());
          for (int j = 0; j < 9; ++j) {
            const double slow = slowDistance(a, 0, b, j, distance), expected = euclidean ? slow * slow : slow;
            EXPECT_NEAR(out[j], expected, 2e-6 * expected);
          }
          if (type != CV_8U) continue;
          for (const float limit : {out[2], std::nextafter(out[2], INFINITY), 0.6f * out[2]}) {
            std::vector<float> limited(9);
            run_bytes(limit, limited);
            for (int j = 0; j < 9; ++j) {
              EXPECT_GE(limited[j], std::min(out[j], limit));
              EXPECT_LE(limited[j], out[j]);
            }
          }
        }
}

TEST(Matching, InstructionSetsAgreeToTheLastBit) {
  const cv::Mat a = randomDescriptors(1, 100, CV_32F, 1), b = randomDescriptors(50, 100, CV_32F, 2);
  std::vector<float> expected(50), out(50);
  const auto run = [&](Isa isa, std::vector<float>& to) {
    distanceKernels(isa).squaredEuclid32(a.ptr<float>(), b.ptr<float>(), 100, 50, to.data());
  };
  run(Isa::kScalar, expected);
  for (const Isa isa : usableIsas()) {
    run(isa, out);
    EXPECT_EQ(out, expected) << name(isa);
  }
}

TEST(Matching, IsTheTextbookWithAndWithoutABand) {
  constexpr int kLeft = 300, kRight = 330;
  const auto left_keypoints = randomKeypoints(kLeft, 1), right_keypoints = randomKeypoints(kRight, 2);
  const std::vector<cv::KeyPoint> none;
  for (const int type : {CV_8U, CV_32F})
    for (const DescriptorDistance distance : kAll)
      for (const float ratio : {0.95f, 1.0f})
        for (const bool mutual : {false, true})
          for (const bool banded : {false, true})
            for (const int threads : {1, 5}) {
              SCOPED_TRACE(testing::Message() << type << " " << static_cast<int>(distance) << " " << ratio
                                              << " " << mutual << " " << banded << " " << threads);
              const cv::Mat left = randomDescriptors(kLeft, 33, type, 3);
              const cv::Mat right = randomDescriptors(kRight, 33, type, 4);
              const MatchOptions options{distance, ratio, mutual, 2400, threads};
              RowBand band;
              if (banded) band = {2.5f, -10, 40};
              const auto& l = banded ? left_keypoints : none;
              const auto& r = banded ? right_keypoints : none;
              // Several candidates may be equally near then, and which of them counts is open.
              if (distance == DescriptorDistance::kChessboard && type == CV_8U) continue;
              const auto expected = SlowMatcher{left, right, options, band, l, r}.run();
              EXPECT_GT(expected.size(), 0u);
              expectEqual(matchKeypoints(left, right, options, band, l, r), expected);
            }
}

TEST(Matching, TakesNeitherOfTwoEquallyNearCandidates) {
  const cv::Mat left = randomDescriptors(2, 64, CV_8U, 1);
  cv::Mat right;
  cv::vconcat(left, left.row(1), right);
  const auto matches = matchKeypoints(left, right);
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].right, 0);
  EXPECT_EQ(matches[0].distance, 0);
}

TEST(Matching, ReadsRowsThatAreApart) {
  const cv::Mat wide = randomDescriptors(40, 100, CV_8U, 1);
  const cv::Mat apart = wide.colRange(3, 67);
  EXPECT_EQ(matchKeypoints(apart, apart.clone()).size(), 40u);
}

TEST(Matching, RefusesWhatDoesNotFit) {
  const cv::Mat bytes = randomDescriptors(3, 64, CV_8U, 1), floats = randomDescriptors(3, 64, CV_32F, 1);
  EXPECT_THROW(matchKeypoints(bytes, floats), std::invalid_argument);
  EXPECT_THROW(matchKeypoints(bytes, bytes.colRange(0, 32)), std::invalid_argument);
  EXPECT_THROW(matchKeypoints(bytes, bytes, {}, {3, 0, 10}), std::invalid_argument);  // without keypoints
  EXPECT_TRUE(matchKeypoints(bytes, {}).empty());
  EXPECT_TRUE(matchKeypoints({}, bytes).empty());
}

}  // namespace
}  // namespace pomona
