// Textbook twin of pyramid/segmentation.h: sets of pixels as lists, every join a pass over all pixels.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

namespace pomona::reference {

/// weight(y, x, v, u): how unlike the pixels (y, x) and (v, u) are. Returns any number per segment, row by
/// row.
inline std::vector<int> segment(int width, int height, const std::function<int(int, int, int, int)>& weight,
                                float k, int min_size) {
  struct Edge {
    int weight, a, b;
  };
  std::vector<Edge> edges;
  const int steps[4][2] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
  for (int y = 0; y < height; ++y)
    for (const auto& [dx, dy] : steps)
      for (int x = 0; x < width; ++x) {
        const int u = x + dx, v = y + dy;
        if (u >= 0 && u < width && v < height)
          edges.push_back({weight(y, x, v, u), y * width + x, v * width + u});
      }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const Edge& a, const Edge& b) { return a.weight < b.weight; });

  std::vector<int> component(static_cast<std::size_t>(width * height));
  for (std::size_t i = 0; i < component.size(); ++i) component[i] = static_cast<int>(i);
  std::map<int, int> internal;  // largest weight inside a component
  const auto size = [&](int c) {
    return static_cast<int>(std::count(component.begin(), component.end(), c));
  };
  const auto join = [&](int a, int b) { std::replace(component.begin(), component.end(), b, a); };
  for (const Edge& e : edges) {
    const int a = component[e.a], b = component[e.b];
    if (a == b) continue;
    const auto limit = [&](int c) {
      return static_cast<float>(internal[c]) + k / static_cast<float>(size(c));
    };
    if (static_cast<float>(e.weight) > std::min(limit(a), limit(b))) continue;
    join(a, b);
    internal[a] = e.weight;
  }
  for (const Edge& e : edges) {
    const int a = component[e.a], b = component[e.b];
    if (a != b && std::min(size(a), size(b)) < min_size) join(a, b);
  }
  return component;
}

}  // namespace pomona::reference
