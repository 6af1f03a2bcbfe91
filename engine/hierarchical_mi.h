// Hierarchical mutual information (Hirschmueller 2008, sec. 2.2): the cost needs a disparity map, the map
// needs a cost; both are refined from a sixteenth of the size upwards.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "engine/sparse_stage.h"
#include "sgm/mutual_information.h"

namespace pomona {

class HierarchicalMi {
 public:
  HierarchicalMi() : mi_(std::make_unique<MutualInformation>()) {}

  /// The cost table for matching `pair` as `settings` says; valid until the next call.
  std::span<const std::uint8_t> table(const MatchInput& pair, const SparseStage::Settings& settings);

 private:
  struct Level {
    Image<std::uint8_t> mask;
    SparseStage stage;
  };
  static constexpr std::array<int, 4> kFactors = {16, 8, 4, 2};
  static constexpr int kIterationsAtStart =
      3;  // "three iterations at 1/16 are enough" to forget the random start

  std::array<Level, kFactors.size()> levels_;
  std::unique_ptr<MutualInformation> mi_;  // a megabyte of tables
};

}  // namespace pomona
