// The fruits of all pictures, and the tables of their errors.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/fruits/measure_fruits.h"

namespace pomona {

/// A method and what it measured.
struct FruitMethod {
  std::string name;
  int scenes = 0;  ///< of each band that it is run on: from the first one on, so many
  struct Fruit {
    std::uint64_t seed;
    int label;
    double visible_share;
    WaysOfOneFruit ways;
  };
  std::array<std::vector<Fruit>, std::size(kBands)> fruits = {};  ///< by band

  DistanceErrors errors(std::size_t band, Way way) const;
};

/// Markdown: all methods with masks; their medians; the other regions and the centre for those that know
/// sigma.
std::string fruitTables(std::span<const FruitMethod> methods);

/// CSV: a line for every fruit, method and way.
std::string fruitList(std::span<const FruitMethod> methods);

}  // namespace pomona
