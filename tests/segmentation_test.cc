#include "pyramid/segmentation.h"

#include <map>

#include "tests/pyramid_support.h"
#include "tests/reference/segmentation.h"

namespace pomona {
namespace {

enum class Fill { kNoise, kFewValues, kPatches, kConstant };

Padded<std::uint8_t> makeImage(int width, int height, int channels, Fill fill, unsigned seed) {
  std::mt19937 random(seed);
  Padded<std::uint8_t> image(width, height, 99, channels);
  image.fill([&](int y, int x, int c) {
    switch (fill) {
      case Fill::kNoise:
        return static_cast<std::uint8_t>(random());
      case Fill::kFewValues:
        return static_cast<std::uint8_t>(random() % 3 * 127);
      case Fill::kPatches:
        return static_cast<std::uint8_t>((x / 9 + 2 * (y / 7)) % 4 * 60 + c * 5 + random() % 9);
      default:
        return std::uint8_t{200};
    }
  });
  return image;
}

// The numbers of `component`, renamed in the order in which they first occur.
std::vector<int> renumbered(const std::vector<int>& component) {
  std::map<int, int> names;
  std::vector<int> result;
  for (int c : component)
    result.push_back(names.try_emplace(c, static_cast<int>(names.size())).first->second);
  return result;
}

void expectTwin(const Padded<std::uint8_t>& image, float k, int min_size, const std::string& text) {
  const auto weight = [&](int y, int x, int v, int u) {
    int largest = 0;
    for (int c = 0; c < image.channels(); ++c)
      largest = std::max(largest, std::abs(image.at(y, x, c) - image.at(v, u, c)));
    return largest;
  };
  const std::vector<int> expected =
      renumbered(reference::segment(image.width(), image.height(), weight, k, min_size));
  Arena arena;
  std::vector<std::int32_t> labels(expected.size());
  forEachSetting([&](const PyramidKernels& kernels, int threads) {
    const Arena::Scope scope(arena);
    SortedEdges edges;
    edges.build(image.guide(), kernels, arena, threads);
    const int count = segment(edges, {k, min_size}, labels.data(), SegmentationScratch(edges, arena));
    ASSERT_EQ(count, *std::max_element(expected.begin(), expected.end()) + 1) << text;
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_EQ(labels[i], expected[i]) << text << " at pixel " << i;
  });
}

TEST(Segmentation, EqualsItsTwin) {
  const std::pair<int, int> sizes[] = {{1, 1}, {1, 9}, {9, 1}, {7, 5}, {31, 12}, {33, 10}, {64, 9}, {65, 11}};
  for (const auto& [width, height] : sizes)
    for (int channels : {1, 3})
      for (Fill fill : {Fill::kNoise, Fill::kFewValues, Fill::kPatches, Fill::kConstant})
        for (float k : {0.0f, 25.0f, 300.0f})
          for (int min_size : {0, 7})
            expectTwin(makeImage(width, height, channels, fill, 5), k, min_size,
                       sizeText(width, height) + ", channels " + std::to_string(channels) + ", fill " +
                           std::to_string(static_cast<int>(fill)) + ", k " + std::to_string(k) +
                           ", min_size " + std::to_string(min_size));
}

// What tells the method from a threshold on the weights: a ramp is one segment although its ends differ, and
// a weak edge in a flat region stays an edge where a strong one in a textured region does not.
TEST(Segmentation, FollowsRampsAndAdaptsToTexture) {
  std::mt19937 random(1);
  Padded<std::uint8_t> image(90, 30, 0);
  image.fill([&](int y, int x, int) {
    if (x < 30) return static_cast<std::uint8_t>(4 * y);               // ramp: 0 to 116
    if (x < 60) return static_cast<std::uint8_t>(x < 45 ? 200 : 220);  // flat, a step of 20
    return static_cast<std::uint8_t>(120 + random() % 40);             // texture, with steps of up to 39
  });
  Arena arena;
  SortedEdges edges;
  std::vector<std::int32_t> labels(90 * 30);
  edges.build(image.guide(), pyramidKernels(Isa::kScalar), arena, 1);
  segment(edges, {900, 20}, labels.data(), SegmentationScratch(edges, arena));
  const auto at = [&](int y, int x) { return labels[static_cast<std::size_t>(y * 90 + x)]; };
  EXPECT_EQ(at(0, 5), at(29, 25));
  EXPECT_NE(at(15, 40), at(15, 50));
  std::map<int, int> pixels_of;
  for (int y = 0; y < 30; ++y)
    for (int x = 60; x < 90; ++x) ++pixels_of[at(y, x)];
  const auto larger = [](const auto& p, const auto& q) { return p.second < q.second; };
  EXPECT_GT(std::max_element(pixels_of.begin(), pixels_of.end(), larger)->second, 700);  // of 900
}

TEST(Segmentation, ScratchServesImagesOfAnySizeAndManyGranularities) {
  Arena arena;
  const PyramidKernels& kernels = pyramidKernels(Isa::kScalar);
  for (const auto& [width, height] : {std::pair(64, 40), std::pair(17, 9), std::pair(80, 50)}) {
    const Padded<std::uint8_t> image = makeImage(width, height, 3, Fill::kPatches, 8);
    std::vector<std::int32_t> labels(static_cast<std::size_t>(width * height)), fresh_labels = labels;
    const Arena::Scope scope(arena);
    SortedEdges reused_edges;
    reused_edges.build(image.guide(), kernels, arena, 1);
    const SegmentationScratch reused(reused_edges, arena);
    for (float k : {400.0f, 10.0f, 90.0f}) {
      Arena fresh;
      SortedEdges edges;
      edges.build(image.guide(), kernels, fresh, 1);
      const int count = segment(edges, {k, 5}, fresh_labels.data(), SegmentationScratch(edges, fresh));
      ASSERT_EQ(segment(reused_edges, {k, 5}, labels.data(), reused), count);
      ASSERT_EQ(labels, fresh_labels);
    }
  }
}

}  // namespace
}  // namespace pomona
