#include "filters/guided_plane.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/parallel.h"

namespace pomona {
namespace {

void packGray(const std::uint8_t* gray, int width, std::uint32_t* color) {
  for (int x = 0; x < width; ++x) color[x] = gray[x] * 0x010101u;
}

void packColor(const std::uint8_t* channels, int width, std::uint32_t* color) {
  const auto pack = [](const std::uint8_t* c) {
    return c[0] | static_cast<std::uint32_t>(c[1]) << 8 | static_cast<std::uint32_t>(c[2]) << 16;
  };
  // Four bytes at a time, where a fourth one follows.
  int x = 0;
  if constexpr (std::endian::native == std::endian::little)
    for (; x + 1 < width; ++x) {
      std::uint32_t four;
      std::memcpy(&four, channels + 3 * x, sizeof four);
      color[x] = four & 0xffffffu;
    }
  for (; x < width; ++x) color[x] = pack(channels + 3 * x);
}

}  // namespace

GuidedPlane::GuidedPlane(ImageView<const float> disparity, GuideView guide, int radius, Arena& arena,
                         int threads) {
  if (guide.channels != 1 && guide.channels != 3)
    throw std::invalid_argument("guide channels are " + std::to_string(guide.channels) + "; allowed: 1, 3");
  const int width = disparity.width, height = disparity.height;
  disparity_ = {arena, width, height, radius, std::numeric_limits<float>::quiet_NaN()};
  color_ = {arena, width, height, radius, 0};
  const auto pack = guide.channels == 1 ? packGray : packColor;
  parallelStrips(threads, height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      std::copy_n(disparity.row(y), width, disparity_.row(y));
      pack(guide.row(y), width, color_.row(y));
    }
  });
}

}  // namespace pomona
