#include "engine/input.h"

#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <string>

#include "core/parallel.h"
#include "core/prefetch.h"

namespace pomona {
namespace {

std::string sizeText(const cv::Mat& m) {
  return std::to_string(m.cols) + "x" + std::to_string(m.rows);
}

void requireImage(const char* argument, const cv::Mat& image) {
  if (image.dims > 2) throw std::invalid_argument(std::string(argument) + " has more than two dimensions");
  if (image.empty()) throw std::invalid_argument(std::string(argument) + " is an empty image");
  const bool depth_fits = image.depth() == CV_8U || image.depth() == CV_16U;
  if (!depth_fits || (image.channels() != 1 && image.channels() != 3))
    throw std::invalid_argument(std::string(argument) + " is of type " + cv::typeToString(image.type()) +
                                "; allowed: CV_8U or CV_16U with 1 or 3 channels");
  constexpr long long kMostPixels = 64'000'000, kLongestSide = 32'000;
  if (image.cols > kLongestSide || image.rows > kLongestSide || 1LL * image.cols * image.rows > kMostPixels)
    throw std::invalid_argument(std::string(argument) + " is " + sizeText(image) +
                                "; allowed: sides up to 32000 and 64 million pixels");
}

template <typename T>
ImageView<const T> viewOf(const cv::Mat& m) {
  return {m.ptr<T>(), m.cols * m.channels(), m.rows, static_cast<std::ptrdiff_t>(m.step1())};
}

constexpr int kGrayBlock = 256;  // pixels between two looks ahead

template <typename T>
ImageView<const T> grayOf(const cv::Mat& image, Image<T>& buffer, void (*to_gray)(const T*, int, T*),
                          int threads) {
  const ImageView<const T> in = viewOf<T>(image);
  if (image.channels() == 1) return in;
  buffer.resize(image.cols, image.rows);
  parallelStrips(threads, image.rows, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < image.cols; x += kGrayBlock) {
        const int count = std::min(kGrayBlock, image.cols - x);
        prefetch(in, y + 1, 3 * x, 3 * count);
        to_gray(in.row(y) + 3 * x, count, buffer.row(y) + x);
      }
  });
  return buffer.view();
}

constexpr std::int64_t kBrightShare = 1000;  // one value of so many may exceed what 8 bits can show

/// By how many bits 16-bit values must shift for 8-bit stages: 10- and 12-bit cameras leave the top ones
/// empty, and a few hot pixels or highlights must not cost the rest their contrast.
int eightBitShift(std::initializer_list<ImageView<const std::uint16_t>> views) {
  std::int64_t total = 0, too_large[9] = {};  // by shift: values for which one less would not do
  for (const ImageView<const std::uint16_t>& view : views) {
    total += std::int64_t{view.width} * view.height;
    for (int y = 0; y < view.height; ++y)
      for (int shift = 1; shift <= 8; ++shift) {
        const std::uint16_t* row = view.row(y);
        const int limit = 1 << (7 + shift);
        int in_row = 0;
        for (int x = 0; x < view.width; ++x) in_row += row[x] >= limit;
        too_large[shift] += in_row;
      }
  }
  int shift = 8;
  while (shift > 0 && too_large[shift] * kBrightShare <= total) --shift;
  return shift;
}

/// Values beyond 8 bits saturate.
ImageView<const std::uint8_t> shiftedDown(ImageView<const std::uint16_t> in, int shift,
                                          Image<std::uint8_t>& buffer, int threads) {
  buffer.resize(in.width, in.height);
  parallelStrips(threads, in.height, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < in.width; ++x)
        buffer.row(y)[x] = static_cast<std::uint8_t>(std::min(in.row(y)[x] >> shift, 255));
  });
  return buffer.view();
}

}  // namespace

void InputPair::set(const cv::Mat& left, const cv::Mat& right, int threads, const SgmKernels& kernels) {
  requireImage("left", left);
  requireImage("right", right);
  if (left.size() != right.size())
    throw std::invalid_argument("right is " + sizeText(right) + " but left is " + sizeText(left) +
                                "; both views must have the same size");
  if (left.type() != right.type())
    throw std::invalid_argument("right is of type " + cv::typeToString(right.type()) + " but left is " +
                                cv::typeToString(left.type()) + "; both views must have the same type");

  const cv::Mat* images[2] = {&left, &right};
  ImageView<const std::uint8_t> gray8[2];
  ImageView<const std::uint16_t> gray16[2];
  GuideView guide;
  if (left.depth() == CV_8U) {
    for (int i = 0; i < 2; ++i) gray8[i] = grayOf(*images[i], buffers_[i].gray8, kernels.gray8, threads);
    const ImageView<const std::uint8_t> v = viewOf<std::uint8_t>(left);
    guide = {v.data, left.cols, left.rows, left.channels(), v.stride};
  } else {
    const int shift = eightBitShift({viewOf<std::uint16_t>(left), viewOf<std::uint16_t>(right)});
    for (int i = 0; i < 2; ++i) {
      gray16[i] = grayOf(*images[i], buffers_[i].gray16, kernels.gray16, threads);
      gray8[i] = shiftedDown(gray16[i], shift, buffers_[i].gray8, threads);
    }
    const ImageView<const std::uint8_t> v =
        left.channels() == 1 ? gray8[0] : shiftedDown(viewOf<std::uint16_t>(left), shift, guide8_, threads);
    guide = {v.data, left.cols, left.rows, left.channels(), v.stride};
  }
  views_ = {gray8[0], gray8[1], gray16[0], gray16[1], guide};
}

void requireRangeFits(int min_disparity, int num_disparities, int width) {
  if (num_disparities > width)
    throw std::invalid_argument("num_disparities is " + std::to_string(num_disparities) +
                                "; allowed: at most the image width, " + std::to_string(width));
  if (min_disparity >= width || min_disparity + num_disparities <= 1 - width)
    throw std::invalid_argument(
        "min_disparity is " + std::to_string(min_disparity) +
        "; allowed: " + std::to_string(2 - width - num_disparities) + " to " + std::to_string(width - 1) +
        ", or no pixel has a match inside the right image of width " + std::to_string(width));
}

void requireMaskFits(const cv::Mat& mask, const cv::Mat& left) {
  if (mask.empty()) return;
  if (mask.type() != CV_8UC1)
    throw std::invalid_argument("mask is of type " + cv::typeToString(mask.type()) + "; allowed: CV_8UC1");
  if (mask.size() != left.size())
    throw std::invalid_argument("mask is " + sizeText(mask) + " but left is " + sizeText(left) +
                                "; both must have the same size");
}

ImageView<const std::uint8_t> maskView(const cv::Mat& mask) {
  if (mask.empty()) return {};
  return viewOf<std::uint8_t>(mask);
}

ImageView<const std::uint8_t> shrunkMask(ImageView<const std::uint8_t> mask, int width, int height,
                                         Image<std::uint8_t>& buffer) {
  if (mask.empty()) return {};
  const auto middle = [](int i, int n, int full) {
    return static_cast<int>((2 * std::int64_t{i} + 1) * full / (2 * n));
  };
  buffer.resize(width, height);
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* row = mask.row(middle(y, height, mask.height));
    for (int x = 0; x < width; ++x) buffer.row(y)[x] = row[middle(x, width, mask.width)];
  }
  return buffer.view();
}

}  // namespace pomona
