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

std::vector<Figure> errorFigures(bool dense) {
  return dense ? std::vector{kBad1, kBad2} : std::vector{kWrong1, kWrong2};
}

std::vector<std::string> scenesOf(const MethodFigures& method) {
  std::vector<std::string> names;
  for (const SceneFigures& scene : method.scenes) names.push_back(scene.scene);
  return names;
}

}  // namespace

// A figure that is NaN must fail, hence the conditions of the form !(good).
std::vector<std::string> accuracyFailures(const std::vector<Method>& methods,
                                          const std::vector<MethodFigures>& found,
                                          const AcceptedFigures& accepted) {
  std::vector<std::string> failures;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Method& method = methods[i];
    if (method.name.starts_with(kPeer)) continue;
    const Figures mean = found[i].mean().all;
    if (scenesOf(found[i]) != accepted.scenes) return {"the scenes are not those of the accepted figures"};
    const auto before = accepted.mean.find(method.name);
    if (before == accepted.mean.end()) {
      failures.push_back(method.name + ": no accepted figures");
      continue;
    }
    for (const Figure figure : errorFigures(method.dense)) {
      const double limit = before->second[figure];
      if (!(mean[figure] <= limit + kTolerancePoints))
        failures.push_back(describe(method.name, figure, mean[figure], "accepted", limit));
    }
    if (!(mean[kCoverage] >= before->second[kCoverage] - kTolerancePoints))
      failures.push_back(
          describe(method.name, kCoverage, mean[kCoverage], "accepted", before->second[kCoverage]));

    if (!method.must_match_peer) continue;
    const auto peer = std::find_if(found.begin(), found.end(), [&](const MethodFigures& other) {
      return other.dense == method.dense && other.method.starts_with(kPeer);
    });
    for (const Figure figure : errorFigures(method.dense)) {
      const double limit = peer == found.end() ? -1 : peer->mean().all[figure];
      if (!(mean[figure] <= limit))
        failures.push_back(describe(method.name, figure, mean[figure], kPeer, limit));
    }
  }
  return failures;
}

}  // namespace pomona
