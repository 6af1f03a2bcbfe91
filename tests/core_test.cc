#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/arena.h"
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

TEST(TaskProgress, FollowersSeeWhatWasWrittenBefore) {
  constexpr int kTasks = 40, kSteps = 50;
  for (int threads : {1, 2, 3, 7, 16}) {
    std::vector<TaskProgress> progress(kTasks);
    std::vector<std::vector<int>> value(kTasks, std::vector<int>(kSteps, -1));
    std::atomic<int> wrong{0};
    parallelFor(threads, kTasks, [&](int task) {
      for (int step = 0; step < kSteps; ++step) {
        if (task > 0) {
          progress[task - 1].await(step + 1);
          wrong += value[task - 1][step] != task - 1 + step;
        }
        value[task][step] = task + step;
        progress[task].reach(step + 1);
      }
    });
    EXPECT_EQ(wrong, 0) << "threads " << threads;
    EXPECT_EQ(value[kTasks - 1][kSteps - 1], kTasks + kSteps - 2);
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

TEST(Arena, GivesTheSameMemoryToOneScopeAfterTheOther) {
  Arena arena;
  const auto stage = [&](int count) {
    const Arena::Scope scope(arena);
    int* const first = arena.take<int>(count);
    {
      const Arena::Scope inner(arena);
      arena.take<int>(count);
    }
    const ImageView<float> image = arena.image<float>(33, 7);
    EXPECT_EQ(image.width, 33);
    EXPECT_EQ(image.height, 7);
    for (int y = 0; y < 7; ++y) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(image.row(y)) % 64, 0u);
    std::fill_n(first, count, 5);
    for (int y = 0; y < 7; ++y) std::fill_n(image.row(y), 33, 7.0f);
    EXPECT_EQ(std::count(first, first + count, 5), count);  // they do not overlap
    return first;
  };
  stage(100'000);
  stage(300'000);
  int* const settled = stage(300'000);
  const std::size_t capacity = arena.capacity();
  EXPECT_GE(capacity, 2 * 300'000 * sizeof(int));
  EXPECT_LE(capacity, 4 * 300'000 * sizeof(int));
  for (int count : {1, 50'000, 300'000}) EXPECT_EQ(stage(count), settled);
  EXPECT_EQ(arena.capacity(), capacity);
}

TEST(Arena, RefusesWhatCannotBe) {
  Arena arena;
  const Arena::Scope scope(arena);
  EXPECT_THROW(arena.take<double>(static_cast<std::size_t>(-1) / 4), std::bad_alloc);
  EXPECT_THROW(arena.take<char>(static_cast<std::size_t>(-1)), std::bad_alloc);
  EXPECT_NE(arena.take<char>(1), nullptr);
}

}  // namespace
}  // namespace pomona
