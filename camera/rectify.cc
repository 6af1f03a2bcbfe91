#include "camera/rectify.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "core/parallel.h"

namespace pomona {
namespace {

constexpr int kStripRows = 16;

std::string sizeText(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

#if CV_SIMD128
/// The mean of four BGR pixels, two above and the two below them, all channels at once: first of the rows (at
/// most 255 * 256, which fits 16 bits), then of the columns; no more is rounded than in one sum of all four.
inline cv::v_int32x4 blendColors(const std::uint8_t* above, const std::uint8_t* below, std::uint32_t fx,
                                 std::uint32_t fy) {
  using namespace cv;
  const v_uint16x8 top = v_load_expand(above), bottom = v_load_expand(below);
  const v_uint16x8 rows = v_add_wrap(
      v_shl<8>(top), v_mul_wrap(v_sub_wrap(bottom, top), v_setall_u16(static_cast<std::uint16_t>(fy))));
  // There is no product of unsigned words whose neighbours are added; 2^15 less, they are signed.
  const v_int16x8 left = v_reinterpret_as_s16(rows ^ v_setall_u16(0x8000));
  v_int16x8 pairs, rest;  // left and right pixel of every channel
  v_zip(left, v_rotate_right<3>(left), pairs, rest);
  return v_shr<16>(v_dotprod(pairs, v_reinterpret_as_s16(v_setall_u32(fx << 16 | (256 - fx))),
                             v_setall_s32((1 << 23) + (1 << 15))));  // 2^15 times both weights; half a unit
}
#endif

}  // namespace

void requireView(const char* name, const cv::Mat& view, cv::Size size) {
  const bool good_type =
      (view.depth() == CV_8U || view.depth() == CV_16U) && (view.channels() == 1 || view.channels() == 3);
  if (!good_type)
    throw std::invalid_argument(std::string(name) + " is of type " + cv::typeToString(view.type()) +
                                "; allowed: CV_8U or CV_16U with 1 or 3 channels");
  if (view.size() != size)
    throw std::invalid_argument(std::string(name) + " is " + sizeText(view.size()) + "; allowed: the rig's " +
                                sizeText(size) + " (calibration and camera must run at the same resolution)");
}

Rectifier::Rectifier(const StereoRig& rig) {
  const Rectification rectification = rectificationOf(rig);
  calibration_ = rectification.calibration;
  input_size_ = {rig.left.width, rig.left.height};
  if (std::min(input_size_.width, input_size_.height) < 2 || calibration_.width <= 0 ||
      calibration_.height <= 0)
    throw std::invalid_argument("the rig's image size is unknown; allowed: a rig with it, to rectify");
  fill(maps_[0], rig.left, rectification.left_rotation, calibration_.cx_px, calibration_);
  fill(maps_[1], rig.right, rectification.right_rotation, calibration_.cx_px + calibration_.doffs_px,
       calibration_);
}

void Rectifier::fill(Map& map, const CameraModel& camera, const cv::Matx33d& rotation, double cx_px,
                     const StereoCalibration& calibration) {
  map.sources.resize(calibration.width, calibration.height);
  map.seen.resize(calibration.width, calibration.height);
  const cv::Matx33d back = rotation.t();
  parallelStrips(availableThreads(), calibration.height, kStripRows, [&](int begin, int end) {
    constexpr double kSteps = 256;
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < calibration.width; ++x) {
        const cv::Vec3d d = back * cv::Vec3d((x - cx_px) / calibration.focal_px,
                                             (y - calibration.cy_px) / calibration.focal_px, 1);
        Source source{0, 0, 0, 0};
        const cv::Vec2d pixel = d[2] > 0 ? camera.pixelOf({d[0] / d[2], d[1] / d[2]}) : cv::Vec2d(-1, -1);
        const double u = std::round(pixel[0] * kSteps), v = std::round(pixel[1] * kSteps);
        const bool seen =
            u >= 0 && v >= 0 && u <= (camera.width - 1) * kSteps && v <= (camera.height - 1) * kSteps;
        if (seen) {
          const int px = std::min(static_cast<int>(u) >> 8, camera.width - 2);
          const int py = std::min(static_cast<int>(v) >> 8, camera.height - 2);
          const int fx = static_cast<int>(u) - (px << 8), fy = static_cast<int>(v) - (py << 8);
          source = {static_cast<std::int16_t>(px), static_cast<std::int16_t>(py),
                    static_cast<std::uint16_t>(fx), static_cast<std::uint16_t>(fy)};
        }
        map.sources.row(y)[x] = source;
        map.seen.row(y)[x] = seen ? 255 : 0;
      }
  });
  for (int y = 0; y < calibration.height; ++y)
    map.all_seen = map.all_seen &&
                   std::memchr(map.seen.row(y), 0, static_cast<std::size_t>(calibration.width)) == nullptr;
}

template <typename T, int kChannels>
void Rectifier::applyRow(const Source* __restrict source, int width, const cv::Mat& view, T* __restrict out) {
  const T* const data = view.ptr<T>();
  const auto stride = static_cast<std::ptrdiff_t>(view.step1());
  [[maybe_unused]] const T* const last = data + (view.rows - 1) * stride + view.cols * kChannels - 8;
  for (int x = 0; x < width; ++x) {
    const Source s = source[x];
    const T* p = data + s.y * stride + s.x * kChannels;
    const std::uint32_t fx = s.fx, fy = s.fy;
    // The loop waits for memory more than for its arithmetic.
    __builtin_prefetch(source + x + 128);
    __builtin_prefetch(p + 2 * stride);
#if CV_SIMD128
    if constexpr (std::is_same_v<T, std::uint8_t> && kChannels == 3) {
      // Eight bytes are read, of which six are the pixels': not those at the end of the image.
      if (p + stride <= last) {
        const cv::v_int16x8 words = cv::v_pack(blendColors(p, p + stride, s.fx, s.fy), cv::v_setzero_s32());
        const std::uint32_t bgr = cv::v_reinterpret_as_u32(cv::v_pack_u(words, words)).get0();
        std::memcpy(out + x * kChannels, &bgr, kChannels);
        continue;
      }
    }
#endif
    const std::uint32_t a = (256 - fx) * (256 - fy), b = fx * (256 - fy), c = (256 - fx) * fy, d = fx * fy;
    for (int k = 0; k < kChannels; ++k)
      out[x * kChannels + k] = static_cast<T>(
          (p[k] * a + p[k + kChannels] * b + p[k + stride] * c + p[k + stride + kChannels] * d + 32768) >>
          16);
  }
}

template <typename T, int kChannels>
void Rectifier::apply(const Map& map, const cv::Mat& view, cv::Mat& rectified, int threads) {
  rectified.create(map.sources.height(), map.sources.width(), view.type());
  parallelStrips(threads, rectified.rows, kStripRows, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      applyRow<T, kChannels>(map.sources.row(y), rectified.cols, view, rectified.ptr<T>(y));
      if (map.all_seen) continue;
      for (int x = 0; x < rectified.cols; ++x)
        if (map.seen.row(y)[x] == 0) std::fill_n(rectified.ptr<T>(y) + x * kChannels, kChannels, T{0});
    }
  });
}

void Rectifier::rectify(const cv::Mat& left, const cv::Mat& right, int threads) {
  requireView("left", left, input_size_);
  requireView("right", right, input_size_);
  if (left.type() != right.type())
    throw std::invalid_argument("right is of type " + cv::typeToString(right.type()) + " but left is " +
                                cv::typeToString(left.type()) + "; both views must have the same type");
  const auto run = left.type() == CV_8UC1    ? apply<std::uint8_t, 1>
                   : left.type() == CV_8UC3  ? apply<std::uint8_t, 3>
                   : left.type() == CV_16UC1 ? apply<std::uint16_t, 1>
                                             : apply<std::uint16_t, 3>;
  run(maps_[0], left, views_[0], threads);
  run(maps_[1], right, views_[1], threads);
}

const cv::Mat& Rectifier::rectifyMask(const cv::Mat& mask, int threads) {
  const Map& map = maps_[0];
  if (mask.empty() && map.all_seen) return no_mask_;
  if (!mask.empty() && (mask.type() != CV_8UC1 || mask.size() != input_size_))
    throw std::invalid_argument("mask is " + cv::typeToString(mask.type()) + " of " + sizeText(mask.size()) +
                                "; allowed: CV_8UC1 of the left view's " + sizeText(input_size_));
  mask_.create(map.seen.height(), map.seen.width(), CV_8UC1);
  parallelStrips(threads, mask_.rows, kStripRows, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < mask_.cols; ++x) {
        const Source s = map.sources.row(y)[x];
        mask_.at<std::uint8_t>(y, x) = mask.empty() || map.seen.row(y)[x] == 0
                                           ? map.seen.row(y)[x]
                                           : mask.at<std::uint8_t>(s.y + (s.fy >= 128), s.x + (s.fx >= 128));
      }
  });
  return mask_;
}

}  // namespace pomona
