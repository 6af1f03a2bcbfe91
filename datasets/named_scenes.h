// Ready-made scenes for the renderer.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/render.h"

namespace pomona {

/// "boxes", "planes", "spheres", "trees".
std::vector<std::string> sceneNames();

/// The scene called `name`, arranged by `seed`. `num_disparities` scales its depths: the nearest surface lies
/// a little below that disparity; 0 stands for a tenth of the width. Every ray meets a surface. Throws
/// std::invalid_argument for an unknown name, a side outside 16..8192, or num_disparities outside 8..width
/// / 2.
SceneDescription namedScene(std::string_view name, std::uint64_t seed, int width, int height,
                            int num_disparities = 0);

/// The same before other cameras than those of 53 degrees and 120 mm: `cameras` is an empty scene.
SceneDescription namedScene(std::string_view name, std::uint64_t seed, const SceneDescription& cameras,
                            int num_disparities = 0);

}  // namespace pomona
