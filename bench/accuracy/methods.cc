#include "bench/accuracy/methods.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace pomona {
namespace {

constexpr std::array<std::string_view, 4> kPresets = {"fast", "balanced", "quality", "paper"};
constexpr std::array<std::string_view, 3> kWindowMethods = {"ssd", "ncc", "asw"};

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> allMethods() {
  std::vector<std::string> names(kPresets.begin(), kPresets.end());
  names.insert(names.end(), kWindowMethods.begin(), kWindowMethods.end());
  for (const MethodInfo& method : methods())
    if (!contains(kPresets, method.name) && !contains(kWindowMethods, method.name))
      names.emplace_back(method.name);
  return names;
}

}  // namespace

MethodOptions Contender::options(int num_disparities) const {
  MethodOptions options;
  options.num_disparities = num_disparities;
  options.mode = kind == MapKind::kDense ? OutputMode::kDense : OutputMode::kSparse;
  options.raw = kind == MapKind::kRaw;
  return options;
}

std::vector<Contender> contenders(std::span<const std::string> names) {
  const std::vector<std::string> all = allMethods();
  if (names.empty()) names = all;
  std::vector<Contender> result;
  for (const MapKind kind : {MapKind::kDense, MapKind::kSparse, MapKind::kRaw})
    for (const std::string& name : names) {
      makeMethod(name);  // throws if there is none
      if (kind == MapKind::kRaw && !contains(kWindowMethods, name)) continue;
      result.push_back({name, kind, contains(kPresets, name) && name != "paper"});
    }
  return result;
}

std::vector<std::string> guardedMethods() {
  return {"fast", "balanced", "quality", "paper", "ssd", "ncc", "asw", kPeer};
}

bool isGuardedOn(const std::string& method, const std::string& scene) {
  constexpr std::array<std::string_view, 3> kSmall = {"cones", "teddy", "venus"};
  return method != "asw" || contains(kSmall, scene);
}

}  // namespace pomona
