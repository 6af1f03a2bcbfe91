#include "bench/accuracy/guard.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace pomona {
namespace {

constexpr double kTolerancePoints = 0.15;

struct Region {
  const char* name;
  Figures SceneFigures::*figures;
};
constexpr Region kRegions[] = {{"all", &SceneFigures::all}, {"non-occluded", &SceneFigures::nonoccluded}};

std::string describe(const std::string& method, const Region& region, Figure figure, double found,
                     const std::string& than, double limit) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << method << ": mean " << kFigureNames[figure] << " of "
      << region.name << " pixels is " << found << ", worse than " << than << " (" << limit << ")";
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

// A figure that is NaN must fail, hence the conditions of the form !(good).
void holdAgainstAccepted(const Contender& contender, const SceneFigures& found, const SceneFigures& accepted,
                         std::vector<std::string>& failures) {
  for (const Region& region : kRegions) {
    const Figures &now = found.*region.figures, &before = accepted.*region.figures;
    if (&region != &kRegions[0] && std::isnan(before[kCoverage])) continue;  // no scene came with that mask
    for (const Figure figure : errorFigures(contender.kind))
      if (!(now[figure] <= before[figure] + kTolerancePoints))
        failures.push_back(
            describe(contender.name(), region, figure, now[figure], "accepted", before[figure]));
    if (!(now[kCoverage] >= before[kCoverage] - kTolerancePoints))
      failures.push_back(
          describe(contender.name(), region, kCoverage, now[kCoverage], "accepted", before[kCoverage]));
  }
}

void holdAgainstPeer(const Contender& contender, const Figures& found, const Figures& peer,
                     std::vector<std::string>& failures) {
  for (const Figure figure : errorFigures(contender.kind))
    if (!(found[figure] <= peer[figure]))
      failures.push_back(describe(contender.name(), kRegions[0], figure, found[figure], kPeer, peer[figure]));
}

}  // namespace

std::vector<std::string> accuracyFailures(const std::vector<Contender>& contenders,
                                          const std::vector<MethodFigures>& found,
                                          const std::vector<MethodFigures>& accepted) {
  std::vector<std::string> failures;
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const Contender& contender = contenders[i];
    if (contender.method.starts_with("opencv") || found[i].scenes.empty()) continue;
    const auto earlier = std::find_if(accepted.begin(), accepted.end(), [&](const MethodFigures& method) {
      return method.method == contender.name();
    });
    if (earlier == accepted.end()) {
      failures.push_back(contender.name() + ": no accepted figures");
      continue;
    }
    const MethodFigures same_scenes = restrictedTo(found[i], *earlier);
    if (same_scenes.scenes.size() != found[i].scenes.size())
      return {"there are scenes without accepted figures"};
    const SceneFigures mean = found[i].mean();
    holdAgainstAccepted(contender, mean, same_scenes.mean(), failures);

    if (!contender.must_match_peer) continue;
    const auto peer = std::find_if(contenders.begin(), contenders.end(), [&](const Contender& other) {
      return other.kind == contender.kind && other.method == kPeer;
    });
    const Figures of_peer = peer == contenders.end()
                                ? noFigures()
                                : found[static_cast<std::size_t>(peer - contenders.begin())].mean().all;
    holdAgainstPeer(contender, mean.all, of_peer, failures);
  }
  return failures;
}

}  // namespace pomona
