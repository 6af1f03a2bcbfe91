#include "bench/robustness/tables.h"

#include <algorithm>
#include <sstream>

#include "bench/accuracy/report.h"
#include "bench/accuracy/table.h"

namespace pomona {
namespace {

constexpr const char* kIntroduction = R"(# Robustness

Written by `pomona_robustness`. The scenes of [accuracy.md](accuracy.md) with the *right* view changed, as two cameras
differ: in exposure, gamma, noise of every channel (0 to 255), focus, height, compression. Dense maps, options and ranges
as there; nothing is told the methods about the change. Vertical shifts are cubic interpolations. Means over the scenes,
percent; in brackets, by how much the change made it worse, in points.

*Scenes less hurt*: on how many scenes A bad-1 rose by less than that of the last method, the peer. The means are ruled
by the few scenes with large textureless surfaces (Midd1, Monopoly, Plastic): what is right there without a change, is
lost; what was wrong, cannot be.
)";

struct Region {
  const char* name;
  Figures SceneFigures::*figures;
};
constexpr Region kAll = {"A ", &SceneFigures::all}, kNonoccluded = {"N ", &SceneFigures::nonoccluded};

std::vector<std::string> headerOf(const std::string& first, const std::vector<MethodFigures>& methods) {
  std::vector<std::string> header = {first};
  for (const MethodFigures& method : methods) header.push_back(method.method);
  return header;
}

void addFigure(std::ostream& out, const std::vector<ChangedFigures>& all, const Region& region,
               Figure figure) {
  out << "\n## " << region.name << kFigureNames[figure] << "\n\n";
  addHeader(out, headerOf("right view", all.front().methods));
  for (const ChangedFigures& changed : all) {
    std::vector<std::string> cells = {changed.change};
    for (std::size_t i = 0; i < changed.methods.size(); ++i) {
      const SceneFigures now = changed.methods[i].mean(), before = all.front().methods[i].mean();
      const double value = (now.*region.figures)[figure], rise = value - (before.*region.figures)[figure];
      cells.push_back(number(value, figure));
      if (&changed != &all.front())
        cells.back() += std::string(rise < 0 ? " (" : " (+") + number(rise, figure) + ")";
    }
    addRow(out, cells);
  }
}

double rise(const std::vector<ChangedFigures>& all, const ChangedFigures& changed, std::size_t method,
            std::size_t scene) {
  return changed.methods[method].scenes[scene].all[kBad1] -
         all.front().methods[method].scenes[scene].all[kBad1];
}

/// A table of what `cellOf(change, method)` says of the changes.
template <typename CellOf>
void addByChange(std::ostream& out, const std::vector<ChangedFigures>& all,
                 const std::vector<MethodFigures>& methods, CellOf cellOf) {
  addHeader(out, headerOf("right view", methods));
  for (const ChangedFigures& changed : all) {
    if (&changed == &all.front()) continue;
    std::vector<std::string> cells = {changed.change};
    for (std::size_t i = 0; i < methods.size(); ++i) cells.push_back(cellOf(changed, i));
    addRow(out, cells);
  }
}

void addMedians(std::ostream& out, const std::vector<ChangedFigures>& all, std::size_t scenes) {
  out << "\n## Rise of A bad-1: median over the scenes\n\n";
  addByChange(out, all, all.front().methods, [&](const ChangedFigures& changed, std::size_t i) {
    std::vector<double> rises;
    for (std::size_t s = 0; s < scenes; ++s) rises.push_back(rise(all, changed, i, s));
    std::sort(rises.begin(), rises.end());
    return number((rises[(scenes - 1) / 2] + rises[scenes / 2]) / 2, kBad1);
  });
}

void addLessHurt(std::ostream& out, const std::vector<ChangedFigures>& all, std::size_t scenes) {
  std::vector<MethodFigures> ours = all.front().methods;
  ours.pop_back();
  out << "\n## Scenes less hurt, of " << scenes << "\n\n";
  addByChange(out, all, ours, [&](const ChangedFigures& changed, std::size_t i) {
    int count = 0;
    for (std::size_t s = 0; s < scenes; ++s)
      count += rise(all, changed, i, s) < rise(all, changed, ours.size(), s);
    return std::to_string(count);
  });
}

}  // namespace

std::string robustnessMarkdown(const std::vector<ChangedFigures>& all) {
  std::ostringstream out;
  out << kIntroduction;
  addFigure(out, all, kAll, kBad1);
  addFigure(out, all, kNonoccluded, kBad1);
  addFigure(out, all, kAll, kBad2);
  const std::size_t scenes = all.front().methods.front().scenes.size();
  addMedians(out, all, scenes);
  addLessHurt(out, all, scenes);
  return out.str();
}

std::string robustnessJson(const std::vector<ChangedFigures>& all) {
  std::string body;
  for (const ChangedFigures& changed : all)
    body += (body.empty() ? "\"" : ",\n\"") + changed.change + "\": " + json(changed.methods);
  return "{\n" + body + "}\n";
}

}  // namespace pomona
