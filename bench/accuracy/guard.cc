#include "bench/accuracy/guard.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace pomona {
namespace {

constexpr double kTolerancePoints = 0.15;

std::string describe(const std::string& method, Figure figure, double found, const std::string& than,
                     double limit) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << method << ": mean " << kFigureNames[figure] << " is " << found
      << ", worse than " << than << " (" << limit << ")";
  return out.str();
}

std::vector<Figure> errorFigures(MapKind kind) {
  return kind == MapKind::kSparse ? std::vector{kWrong1, kWrong2} : std::vector{kBad1, kBad2};
}

/// The part of `accepted` that is about the scenes of `found`; fewer scenes than there if some are unknown.
MethodFigures restrictedTo(const MethodFigures& found, const MethodFigures& accepted) {
  MethodFigures part{accepted.method, accepted.kind, {}};
  for (const SceneFigures& scene : found.scenes)
    for (const SceneFigures& known : accepted.scenes)
      if (known.scene == scene.scene) part.scenes.push_back(known);
  return part;
}

}  // namespace

// A figure that is NaN must fail, hence the conditions of the form !(good).
std::vector<std::string> accuracyFailures(const std::vector<Contender>& contenders,
                                          const std::vector<MethodFigures>& found,
                                          const std::vector<MethodFigures>& accepted) {
  std::vector<std::string> failures;
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const Contender& contender = contenders[i];
    if (contender.method.starts_with("opencv")) continue;
    const std::string name = contender.name();
    const Figures mean = found[i].mean().all;
    const auto earlier = std::find_if(accepted.begin(), accepted.end(),
                                      [&](const MethodFigures& method) { return method.method == name; });
    if (earlier == accepted.end()) {
      failures.push_back(name + ": no accepted figures");
      continue;
    }
    const MethodFigures same_scenes = restrictedTo(found[i], *earlier);
    if (same_scenes.scenes.size() != found[i].scenes.size())
      return {"there are scenes without accepted figures"};
    const Figures before = same_scenes.mean().all;
    for (const Figure figure : errorFigures(contender.kind)) {
      const double limit = before[figure];
      if (!(mean[figure] <= limit + kTolerancePoints))
        failures.push_back(describe(name, figure, mean[figure], "accepted", limit));
    }
    if (!(mean[kCoverage] >= before[kCoverage] - kTolerancePoints))
      failures.push_back(describe(name, kCoverage, mean[kCoverage], "accepted", before[kCoverage]));

    if (!contender.must_match_peer) continue;
    const auto peer = std::find_if(contenders.begin(), contenders.end(), [&](const Contender& other) {
      return other.kind == contender.kind && other.method == kPeer;
    });
    for (const Figure figure : errorFigures(contender.kind)) {
      const double limit =
          peer == contenders.end()
              ? -1
              : found[static_cast<std::size_t>(peer - contenders.begin())].mean().all[figure];
      if (!(mean[figure] <= limit)) failures.push_back(describe(name, figure, mean[figure], kPeer, limit));
    }
  }
  return failures;
}

}  // namespace pomona
