// After the first frame of a size, a frame allocates nothing: no malloc anywhere in the process.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

#include "datasets/named_scenes.h"
#include "datasets/render.h"
#include "pomona/engine.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define POMONA_CANNOT_COUNT  // these bring their own malloc
#endif

namespace {
std::atomic<long> allocations{0};
}

#if !defined(POMONA_CANNOT_COUNT)
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* p, std::size_t size) {
  ++allocations;
  return __libc_realloc(p, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** p, std::size_t alignment, std::size_t size) {
  ++allocations;
  *p = __libc_memalign(alignment, size);
  return *p ? 0 : ENOMEM;
}
}
#endif

namespace pomona {
namespace {

/// How often `frames` frames allocate: frame(i) is the i-th.
template <typename Frame>
long allocationsIn(int frames, Frame frame) {
  const long before = allocations;
  for (int i = 0; i < frames; ++i) frame(i);
  return allocations - before;
}

TEST(Engine, FramesAfterTheFirstAllocateNothing) {
#if defined(POMONA_CANNOT_COUNT)
  GTEST_SKIP() << "allocations cannot be counted in this build";
#endif
  const RenderedPair first = render(namedScene("boxes", 1, 160, 100, 30));
  const RenderedPair other = render(namedScene("trees", 2, 160, 100, 30));
  for (const char* preset : {"fast", "balanced", "quality", "paper"})
    for (OutputMode mode : {OutputMode::kSparse, OutputMode::kDense})
      for (int threads : {1, 3}) {
        Options o = Options::preset(preset);
        o.num_disparities = 36;
        o.mode = mode;
        o.threads = threads;
        StereoEngine engine(o);
        // A coarse map is made for a frame that needs one: the warm-up has to meet both kinds of frame.
        engine.compute(first.left.image, first.right.image);
        engine.compute(other.left.image, other.right.image);
        const auto alternate = [&](int i) {
          const RenderedPair& pair = i % 2 ? first : other;
          engine.compute(pair.left.image, pair.right.image);
        };
        EXPECT_EQ(allocationsIn(10, alternate), 0)
            << preset << " mode " << static_cast<int>(mode) << " threads " << threads;
      }
  {
    // The same views, taken as an unrectified camera's: what is measured is the rectifying.
    StereoRig rig = rigOf(first.calibration);
    rig.rectification.reset();
    rig.left.distortion[0] = rig.right.distortion[0] = -0.1;
    Options o;
    o.num_disparities = 36;
    o.threads = 3;
    StereoEngine engine(o, rig);
    const cv::Mat mask(first.left.image.size(), CV_8UC1, cv::Scalar(255));
    engine.compute(first.left.image, first.right.image, mask);
    engine.compute(other.left.image, other.right.image, mask);
    const auto alternate = [&](int i) {
      const RenderedPair& pair = i % 2 ? first : other;
      engine.compute(pair.left.image, pair.right.image, mask);
    };
    EXPECT_EQ(allocationsIn(10, alternate), 0) << "with a rig";
  }
  {
    const RenderedPair pair = render(namedScene("boxes", 3, 480, 320, 48));
    cv::Mat lower(pair.right.image.size(), pair.right.image.type());
    pair.right.image.rowRange(0, 319).copyTo(lower.rowRange(1, 320));
    pair.right.image.row(0).copyTo(lower.row(0));
    Options o;
    o.threads = 3;
    StereoEngine engine(o);
    engine.compute(pair.left.image, lower);
    const auto aligned = [&](int) { EXPECT_TRUE(engine.compute(pair.left.image, lower).rows_aligned); };
    EXPECT_EQ(allocationsIn(5, aligned), 0) << "with rows to be moved";
  }
  {
    const RenderedPair large = render(namedScene("boxes", 1, 320, 256, 40));
    const RenderedPair small = render(namedScene("trees", 2, 320, 256, 40));
    Options o;
    o.num_disparities = 160;
    o.adaptive_range = true;
    o.threads = 3;
    StereoEngine engine(o);
    engine.compute(large.left.image, large.right.image);
    engine.compute(small.left.image, small.right.image);
    const auto alternate = [&](int i) {
      const RenderedPair& pair = i % 2 ? large : small;
      engine.compute(pair.left.image, pair.right.image);
    };
    EXPECT_EQ(allocationsIn(6, alternate), 0) << "with an adaptive range";
  }
  EXPECT_GT(allocationsIn(1, [](int) { std::free(std::malloc(10)); }), 0) << "the counter does not count";
}

}  // namespace
}  // namespace pomona
