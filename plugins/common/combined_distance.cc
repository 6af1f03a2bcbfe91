#include "plugins/common/combined_distance.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace pomona {
namespace {

// Loops that compilers turn into vectors of bytes (psadbw, pmaxub and their like). They are inlined into
// functions compiled for one instruction set each.
#define POMONA_INLINE inline __attribute__((always_inline))

POMONA_INLINE int cityBlocks(const std::uint8_t* a, const std::uint8_t* b, int length) {
  int sum = 0;
  for (int i = 0; i < length; ++i) sum += std::abs(a[i] - b[i]);
  return sum;
}

POMONA_INLINE int chessboard(const std::uint8_t* a, const std::uint8_t* b, int length) {
  std::uint8_t most = 0;
  for (int i = 0; i < length; ++i) {
    const std::uint8_t difference = a[i] > b[i] ? a[i] - b[i] : b[i] - a[i];
    most = difference > most ? difference : most;
  }
  return most;
}

POMONA_INLINE int distanceBelow(const std::uint8_t* a, const std::uint8_t* b, int length, int bound) {
  const int sum = cityBlocks(a, b, length);
  return sum < bound ? sum + chessboard(a, b, length) : sum;
}

POMONA_INLINE TwoNearest twoNearest(const std::uint8_t* query, const std::uint8_t* others, std::size_t step,
                                    int count, int length) {
  TwoNearest found;
  for (int j = 0; j < count; ++j, others += step) {
    const int distance = distanceBelow(query, others, length, found.second_distance);
    if (distance >= found.second_distance) continue;
    if (distance < found.distance) {
      found.second_distance = found.distance;
      found.distance = distance;
      found.nearest = j;
    } else {
      found.second_distance = distance;
    }
  }
  return found;
}

constexpr int kSiftLength = 128;  // known when compiled, it needs no loop

struct Functions {
  int (*distance_below)(const std::uint8_t*, const std::uint8_t*, int, int);
  TwoNearest (*two_nearest)(const std::uint8_t*, const std::uint8_t*, std::size_t, int, int);
};

#define POMONA_DISTANCE_FUNCTIONS(name, attribute)                                                     \
  attribute int distanceBelow_##name(const std::uint8_t* a, const std::uint8_t* b, int n, int bound) { \
    return n == kSiftLength ? distanceBelow(a, b, kSiftLength, bound) : distanceBelow(a, b, n, bound); \
  }                                                                                                    \
  attribute TwoNearest twoNearest_##name(const std::uint8_t* query, const std::uint8_t* others,        \
                                         std::size_t step, int count, int n) {                         \
    return n == kSiftLength ? twoNearest(query, others, step, count, kSiftLength)                      \
                            : twoNearest(query, others, step, count, n);                               \
  }                                                                                                    \
  constexpr Functions kFunctions_##name{distanceBelow_##name, twoNearest_##name};

POMONA_DISTANCE_FUNCTIONS(baseline, )
#if defined(__x86_64__)
POMONA_DISTANCE_FUNCTIONS(avx2, __attribute__((target("avx2"))))
#endif

const Functions& functions() {
#if defined(__x86_64__)
  static const Functions& best = __builtin_cpu_supports("avx2") ? kFunctions_avx2 : kFunctions_baseline;
  return best;
#else
  return kFunctions_baseline;
#endif
}

void requireDescriptors(const cv::Mat& queries, const cv::Mat& others) {
  for (const cv::Mat* m : {&queries, &others})
    if (!m->empty() && m->type() != CV_8UC1) throw std::invalid_argument("descriptors are not of 8 bits");
  if (!queries.empty() && !others.empty() && queries.cols != others.cols)
    throw std::invalid_argument("descriptors have " + std::to_string(queries.cols) + " and " +
                                std::to_string(others.cols) + " values; allowed: equally many");
}

}  // namespace

int combinedDistance(const std::uint8_t* a, const std::uint8_t* b, int length) {
  return combinedDistanceBelow(a, b, length, TwoNearest::kNone);
}

int combinedDistanceBelow(const std::uint8_t* a, const std::uint8_t* b, int length, int bound) {
  return functions().distance_below(a, b, length, bound);
}

std::vector<TwoNearest> findTwoNearest(const cv::Mat& queries, const cv::Mat& others) {
  requireDescriptors(queries, others);
  std::vector<TwoNearest> found(static_cast<std::size_t>(queries.rows));
  if (others.empty()) return found;
  for (int i = 0; i < queries.rows; ++i)
    found[static_cast<std::size_t>(i)] =
        functions().two_nearest(queries.ptr(i), others.ptr(), others.step, others.rows, others.cols);
  return found;
}

}  // namespace pomona
