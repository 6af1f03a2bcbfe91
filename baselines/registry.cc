#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "baselines/method.h"

namespace pomona {

// A file of methods hands them out by a function of this kind. A new file needs its name in both lines.
using MethodList = std::span<const MethodInfo>();
MethodList aswMethods, nccMethods, openCvMethods, openCvWlsMethods, presetMethods, ssdMethods;
static constexpr MethodList* kLists[] = {aswMethods,       nccMethods,    openCvMethods,
                                         openCvWlsMethods, presetMethods, ssdMethods};

ValidationOptions PostProcessing::over(ValidationOptions usual) const {
  usual.left_right_px = left_right_px.value_or(usual.left_right_px);
  usual.speckle_size_px = speckle_size_px.value_or(usual.speckle_size_px);
  usual.median_size = median_size.value_or(usual.median_size);
  return usual;
}

std::span<const MethodInfo> methods() {
  static const std::vector<MethodInfo> sorted = [] {
    std::vector<MethodInfo> all;
    for (MethodList* list : kLists) all.insert(all.end(), list().begin(), list().end());
    std::sort(all.begin(), all.end(),
              [](const MethodInfo& a, const MethodInfo& b) { return a.name < b.name; });
    return all;
  }();
  return sorted;
}

std::unique_ptr<Method> makeMethod(std::string_view name) {
  std::string allowed;
  for (const MethodInfo& method : methods()) {
    if (method.name == name) return method.make();
    allowed += (allowed.empty() ? "" : ", ") + std::string(method.name);
  }
  throw std::invalid_argument("method \"" + std::string(name) + "\" is unknown; allowed: " + allowed);
}

}  // namespace pomona
