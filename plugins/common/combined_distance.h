// The distance between 8-bit descriptors that weighs city blocks and the chessboard alike.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace pomona {

/// sum |a_i - b_i| + max |a_i - b_i|: twice L = 0.5 cityblock + 0.5 chessboard, and so an integer. Exact on
/// every machine. `length`: values of a descriptor, up to 4096.
int combinedDistance(const std::uint8_t* a, const std::uint8_t* b, int length);

/// The same if it is below `bound`, else some number that is not: the chessboard is looked at only where the
/// city blocks leave the question open.
int combinedDistanceBelow(const std::uint8_t* a, const std::uint8_t* b, int length, int bound);

struct TwoNearest {
  static constexpr int kNone = 1 << 30;

  int nearest = -1;  ///< row of the other descriptors; of equally near ones the first
  int distance = kNone, second_distance = kNone;
};

/// For each row of `queries` the two nearest rows of `others`. Both CV_8U, of equally many columns, or empty.
/// Throws std::invalid_argument for other types or sizes.
std::vector<TwoNearest> findTwoNearest(const cv::Mat& queries, const cv::Mat& others);

}  // namespace pomona
