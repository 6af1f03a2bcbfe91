// What is compared: the methods of the registry, each in several modes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "baselines/method.h"

namespace pomona {

enum class MapKind {
  kDense,   ///< every pixel has a value
  kSparse,  ///< only what passed the checks
  kRaw,     ///< winners as they are
};
inline constexpr const char* kMapKindNames[] = {"dense", "sparse", "raw"};

struct Contender {
  std::string method;  ///< its name in the registry
  MapKind kind;
  /// Dense and sparse alike must be no worse than the peer's map of their kind. Asked of Pomona's presets,
  /// but for `paper`, which reproduces a baseline.
  bool must_match_peer;

  std::string name() const { return method + " " + kMapKindNames[static_cast<int>(kind)]; }
  MethodOptions options(int num_disparities) const;
};

inline constexpr const char* kPeer = "opencv-hh";

/// In the order of the tables: presets, window methods, OpenCV's; `names` empty: all. Raw maps are of the
/// window methods only. Throws std::invalid_argument for a name that is not in the registry.
std::vector<Contender> contenders(std::span<const std::string> names = {});

/// Those that the guard runs: the presets, the peer, and the window methods.
std::vector<std::string> guardedMethods();

/// Whether the guard runs the method on this scene: adaptive support weights, which take tens of times as
/// long as the others, on three small ones only.
bool isGuardedOn(const std::string& method, const std::string& scene);

}  // namespace pomona
