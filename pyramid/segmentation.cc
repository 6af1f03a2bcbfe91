#include "pyramid/segmentation.h"

#include <algorithm>
#include <numeric>

#include "core/parallel.h"

namespace pomona {
namespace {

constexpr int kMinRowsPerStrip = 16;

struct Step {
  int dx, dy;
};
constexpr std::array<Step, SortedEdges::kDirections> kSteps = {{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

// Disjoint sets of pixels. `limit` of a root is Int(C) + k / |C|.
class Forest {
 public:
  Forest(int pixels, float k, SegmentationScratch& scratch) : k_(k) {
    for (Buffer<int>* b : {&scratch.parent, &scratch.size}) b->resize(static_cast<std::size_t>(pixels));
    scratch.limit.resize(static_cast<std::size_t>(pixels));
    parent_ = scratch.parent.data();
    size_ = scratch.size.data();
    limit_ = scratch.limit.data();
    std::iota(parent_, parent_ + pixels, 0);
    std::fill_n(size_, pixels, 1);
    std::fill_n(limit_, pixels, k);
  }
  int root(int i) const {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  bool areSimilar(int a, int b, int weight) const {
    return static_cast<float>(weight) <= std::min(limit_[a], limit_[b]);
  }
  bool isOneSmaller(int a, int b, int size) const { return std::min(size_[a], size_[b]) < size; }
  // Of two roots. Weights only grow, so this one is the largest so far.
  void join(int a, int b, int weight) {
    if (size_[a] < size_[b]) std::swap(a, b);
    parent_[b] = a;
    size_[a] += size_[b];
    limit_[a] = static_cast<float>(weight) + k_ / static_cast<float>(size_[a]);
  }

 private:
  float k_;
  int* parent_;
  int* size_;
  float* limit_;
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

void SortedEdges::build(GuideView image, const PyramidKernels& kernels, int threads) {
  width_ = image.width;
  height_ = image.height;
  for (std::size_t i = 0; i < kSteps.size(); ++i) offset_[i] = kSteps[i].dy * width_ + kSteps[i].dx;
  weights_.resize(width_, kDirections * height_);
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
  edges_.resize(count());
  forEachEdge([&](std::uint8_t weight, std::uint32_t edge) { edges_[next[weight]++] = edge; });
}

int segment(const SortedEdges& edges, const SegmentationParameters& parameters, Image<std::int32_t>& labels,
            SegmentationScratch& scratch) {
  const int pixels = edges.width() * edges.height();
  Forest forest(pixels, parameters.k, scratch);

  // Edges that join nothing are kept: small components need no others.
  scratch.between.resize(edges.count());
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
  for (const std::uint32_t edge : std::span(scratch.between.data(), between)) {
    const int a = forest.root(SortedEdges::firstEnd(edge)), b = forest.root(edges.otherEnd(edge));
    if (a != b && forest.isOneSmaller(a, b, parameters.min_size_px)) forest.join(a, b, 0);
  }

  int* label_of_root = scratch.size.data();  // sizes have done their duty
  std::fill_n(label_of_root, pixels, -1);
  labels.resize(edges.width(), edges.height());
  int segments = 0;
  for (int y = 0; y < edges.height(); ++y)
    for (int x = 0; x < edges.width(); ++x) {
      int& label = label_of_root[forest.root(y * edges.width() + x)];
      if (label < 0) label = segments++;
      labels.row(y)[x] = label;
    }
  return segments;
}

}  // namespace pomona
