#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/cpu.h"
#include "core/image.h"
#include "core/parallel.h"

namespace pomona {
namespace {

TEST(ParallelFor, RunsEveryTaskOnceForAnyThreadCount) {
  for (int threads : {-1, 0, 1, 2, 3, 7, 16}) {
    std::vector<int> calls(101, 0);
    parallelFor(threads, 101, [&](int i) { ++calls[i]; });
    for (int c : calls) EXPECT_EQ(c, 1) << "threads " << threads;
  }
}

TEST(ParallelFor, HandsOnWhatATaskThrows) {
  for (int threads : {1, 2, 7})
    for (int round = 0; round < 50; ++round)
      EXPECT_THROW(parallelFor(threads, 20,
                               [&](int i) {
                                 if (i == round % 20) throw std::bad_alloc();
                               }),
                   std::bad_alloc);
}

TEST(ParallelStrips, CoversAllRowsWithoutOverlap) {
  for (int threads : {1, 2, 7})
    for (int rows : {1, 2, 5, 97, 720})
      for (int min_rows : {0, 1, 16, 1000}) {
        std::vector<std::atomic<int>> seen(rows);
        parallelStrips(threads, rows, min_rows, [&](int begin, int end) {
          for (int y = begin; y < end; ++y) ++seen[y];
        });
        for (auto& s : seen) EXPECT_EQ(s, 1) << threads << ' ' << rows << ' ' << min_rows;
      }
}

TEST(Isa, ScalarIsAlwaysThereAndBadNamesAreRefused) {
  EXPECT_EQ(usableIsas().front(), Isa::kScalar);
  EXPECT_EQ(chooseIsa("scalar"), Isa::kScalar);
  try {
    chooseIsa("sse9");
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("sse9"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("scalar"), std::string::npos);
  }
}

TEST(Isa, EnvironmentIsHonouredAndTheRequestWins) {
  setenv("POMONA_ISA", "scalar", 1);
  EXPECT_EQ(chooseIsa(""), Isa::kScalar);
  EXPECT_EQ(chooseIsa(name(usableIsas().back())), usableIsas().back());
  setenv("POMONA_ISA", "nonsense", 1);
  EXPECT_THROW(chooseIsa(""), std::invalid_argument);
  unsetenv("POMONA_ISA");
}

TEST(Image, RowsAreAlignedAndMemoryIsKept) {
  Image<float> image(33, 7);
  for (int y = 0; y < 7; ++y) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(image.row(y)) % 64, 0u);
  const float* before = image.row(0);
  image.resize(5, 3);
  EXPECT_EQ(image.row(0), before);
}

}  // namespace
}  // namespace pomona
