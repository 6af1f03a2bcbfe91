// Plugins that cannot be used, one for each value of POMONA_BROKEN.
#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include "pomona/plugin.h"

namespace {

enum Broken {
  kThrowsInCreate,
  kThrowsNumberInCreate,
  kBadName,
  kBadDefault,
  kTwoParametersOfOneName,
  kBadSet,
  kSameName,
  kThrowsInName,
  kNothing,
  kThrowsAtOpening,
  kLeavesAtOpening,
  kCrashesAtOpening,
  kCrashesInCreate,
  kOtherVersion,
  kOtherBuild,
  kOtherLayout,
  kNoEntry,
  kThrowsInEntry,
};

// Runs as the file is opened.
[[maybe_unused]] const bool opened = [] {
  if (POMONA_BROKEN == kThrowsAtOpening) throw std::runtime_error("no static luck");
  if (POMONA_BROKEN == kLeavesAtOpening) std::exit(3);
  if (POMONA_BROKEN == kCrashesAtOpening) std::raise(SIGSEGV);
  return true;
}();

class Plugin final : public pomona::SparseStereoPlugin {
 public:
  Plugin() {
    if (POMONA_BROKEN == kThrowsInCreate) throw std::runtime_error("no\nluck");
    if (POMONA_BROKEN == kThrowsNumberInCreate) throw 7;
    if (POMONA_BROKEN == kCrashesInCreate) std::raise(SIGSEGV);
  }
  std::string name() const override {
    if (POMONA_BROKEN == kThrowsInName) throw std::runtime_error("nameless");
    if (POMONA_BROKEN == kSameName) return "middle";
    return POMONA_BROKEN == kBadName ? "Bad name" : "broken";
  }
  std::string description() const override { return ""; }
  std::vector<pomona::PluginParameter> parameters() const override {
    std::vector<pomona::PluginParameter> parameters{pomona::realParameter("ratio", "", 0.5, 0, 1)};
    if (POMONA_BROKEN == kBadDefault) parameters[0].max = 0.25;
    if (POMONA_BROKEN == kTwoParametersOfOneName) parameters.push_back(parameters[0]);
    return parameters;
  }
  std::vector<pomona::ParameterSet> parameterSets() const override {
    return {{"faithful", "", {{"ratio", POMONA_BROKEN == kBadSet ? "1.5" : "0.7"}}}};
  }
  pomona::SparseResult run(const pomona::RectifiedPair&, const pomona::StereoCalibration&,
                           const pomona::PluginInputs&) override {
    return {};
  }
};

[[maybe_unused]] pomona::SparseStereoPlugin* create() {
  if (POMONA_BROKEN >= kOtherVersion) std::abort();  // must not be called
  return POMONA_BROKEN == kNothing ? nullptr : new Plugin;
}

}  // namespace

#if !defined(POMONA_WITHOUT_ENTRY)
extern "C" [[gnu::visibility("default")]] const pomona::PluginEntry* pomona_plugin_entry() {
  static const pomona::PluginEntry entry{
      pomona::kPluginAbiVersion + (POMONA_BROKEN == kOtherVersion ? 1u : 0u),
      POMONA_BROKEN == kOtherBuild ? "another compiler" : pomona::pluginBuildTag(),
      pomona::pluginStructBytes() + (POMONA_BROKEN == kOtherLayout ? 8u : 0u), create,
      [](pomona::SparseStereoPlugin* plugin) { delete plugin; }};
  if (POMONA_BROKEN == kThrowsInEntry) throw 7;
  return POMONA_BROKEN == kNoEntry ? nullptr : &entry;
}
#endif
