// The files of a rendered scene.
#pragma once

#include <string>
#include <vector>

#include "datasets/atomic_file.h"
#include "datasets/rendering/orchard.h"
#include "datasets/rendering/storefront.h"

namespace pomona {

/// Views, disparities, masks and calibration under Middlebury's names.
std::vector<OutputFile> pairFiles(const RenderedPair& pair);
/// fruits.json and fruits0.png: what docs/rendering.md says of them.
std::vector<OutputFile> fruitFiles(const Orchard& orchard, const RenderedPair& pair);
/// signs.json
std::vector<OutputFile> signFiles(const Storefront& storefront, const RenderedPair& pair);

}  // namespace pomona
