#include "pyramid/segmentation.h"

#include <algorithm>
#include <utility>

#include "core/parallel.h"

namespace pomona {
namespace {

constexpr int kMinRowsPerStrip = 16;

struct Step {
  int dx, dy;
};
constexpr std::array<Step, SortedEdges::kDirections> kSteps = {{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

// Disjoint sets of pixels. The limit of a root is Int(C) + k / |C|.
class Forest {
 public:
  using Node = SegmentationScratch::Node;

  Forest(int pixels, float k, const SegmentationScratch& scratch)
      : k_(k), nodes_(scratch.nodes), size_(scratch.size) {
    for (int i = 0; i < pixels; ++i) nodes_[i] = {i, k};
    std::fill_n(size_, pixels, 1);
  }
  int root(int i) const {
    while (nodes_[i].parent != i) i = nodes_[i].parent = nodes_[nodes_[i].parent].parent;
    return i;
  }
  bool areSimilar(int a, int b, int weight) const {
    return static_cast<float>(weight) <= std::min(nodes_[a].limit, nodes_[b].limit);
  }
  bool isOneSmaller(int a, int b, int size) const { return std::min(size_[a], size_[b]) < size; }
  // Of two roots. While weights only grow, this one is the largest of the component.
  void join(int a, int b, int weight) {
    if (size_[a] < size_[b]) std::swap(a, b);
    nodes_[b].parent = a;
    size_[a] += size_[b];
    nodes_[a].limit = static_cast<float>(weight) + k_ / static_cast<float>(size_[a]);
  }

 private:
  float k_;
  Node* nodes_;
  int* size_;
};

}  // namespace

template <typename F>
void SortedEdges::forEachEdge(F visit) const {
  for (int y = 0; y < height_; ++y)
    for (int i = 0; i < kDirections; ++i) {
      const Step step = kSteps[static_cast<std::size_t>(i)];
      if (y + step.dy >= height_) continue;
      const std::uint8_t* weights = weights_.row(y * kDirections + i);
      const std::uint32_t row = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width_);
      const int end = width_ - std::max(0, step.dx);
      for (int x = std::max(0, -step.dx); x < end; ++x)
        visit(weights[x],
              kDirections * (row + static_cast<std::uint32_t>(x)) + static_cast<std::uint32_t>(i));
    }
}

void SortedEdges::build(GuideView image, const PyramidKernels& kernels, Arena& arena, int threads) {
  width_ = image.width;
  height_ = image.height;
  for (std::size_t i = 0; i < kSteps.size(); ++i) offset_[i] = kSteps[i].dy * width_ + kSteps[i].dx;
  weights_ = arena.image<std::uint8_t>(width_, kDirections * height_);
  const auto difference = image.channels == 3 ? kernels.largestDifference3 : kernels.difference1;
  parallelStrips(threads, height_, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int i = 0; i < kDirections; ++i) {
        const Step step = kSteps[static_cast<std::size_t>(i)];
        if (y + step.dy >= height_) continue;
        const int x = std::max(0, -step.dx);
        difference(image.row(y) + x * image.channels, image.row(y + step.dy) + (x + step.dx) * image.channels,
                   width_ - std::abs(step.dx), weights_.row(y * kDirections + i) + x);
      }
  });

  std::array<std::uint32_t, kWeights> next{};
  forEachEdge([&](std::uint8_t weight, std::uint32_t) { ++next[weight]; });
  begin_[0] = 0;
  for (std::size_t w = 0; w < kWeights; ++w) {
    begin_[w + 1] = begin_[w] + next[w];
    next[w] = begin_[w];
  }
  edges_ = arena.take<std::uint32_t>(count());
  forEachEdge([&](std::uint8_t weight, std::uint32_t edge) { edges_[next[weight]++] = edge; });
}

SegmentationScratch::SegmentationScratch(const SortedEdges& edges, Arena& arena) {
  const std::size_t pixels =
      static_cast<std::size_t>(edges.width()) * static_cast<std::size_t>(edges.height());
  nodes = arena.take<Node>(pixels);
  size = arena.take<int>(pixels);
  between = arena.take<std::uint32_t>(edges.count());
}

int segment(const SortedEdges& edges, const SegmentationParameters& parameters, std::int32_t* labels,
            const SegmentationScratch& scratch) {
  const int pixels = edges.width() * edges.height();
  Forest forest(pixels, parameters.k, scratch);

  // Edges that join nothing are kept: small components need no others.
  std::size_t between = 0;
  for (int weight = 0; weight < SortedEdges::kWeights; ++weight)
    for (const std::uint32_t edge : edges.ofWeight(weight)) {
      const int a = forest.root(SortedEdges::firstEnd(edge)), b = forest.root(edges.otherEnd(edge));
      if (a == b) continue;
      if (forest.areSimilar(a, b, weight))
        forest.join(a, b, weight);
      else
        scratch.between[between++] = edge;
    }
  for (const std::uint32_t edge : std::span(scratch.between, between)) {
    const int a = forest.root(SortedEdges::firstEnd(edge)), b = forest.root(edges.otherEnd(edge));
    if (a != b && forest.isOneSmaller(a, b, parameters.min_size_px)) forest.join(a, b, 0);
  }

  // The label at a component's root is -1 until the component is met.
  std::fill_n(labels, pixels, -1);
  int segments = 0;
  for (int i = 0; i < pixels; ++i) {
    std::int32_t& label = labels[forest.root(i)];
    if (label < 0) label = segments++;
    labels[i] = label;
  }
  return segments;
}

}  // namespace pomona
