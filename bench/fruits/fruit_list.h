// The fruits of all pictures, and the file that keeps what was measured of them.
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
    std::uint64_t seed;  ///< of its orchard
    int label;
    double visible_share;
    WaysOfOneFruit ways;
  };
  std::array<std::vector<Fruit>, std::size(kBands)> fruits = {};  ///< by band

  DistanceErrors errors(std::size_t band, Way way) const;
};

/// CSV: a line for every fruit and method; what is not known is left empty.
std::string fruitList(const std::string& rig, std::span<const FruitMethod> methods);

/// Adds the measurements in a file of fruitList() to those of the methods of the same names, or as new
/// methods behind them. Throws std::runtime_error naming file, line and what is wrong; another rig than `rig`
/// is.
void addFruitList(const std::string& path, const std::string& rig, std::vector<FruitMethod>& methods);

}  // namespace pomona
