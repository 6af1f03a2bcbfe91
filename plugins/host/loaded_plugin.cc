#include <dlfcn.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "plugins/host/checks.h"
#include "plugins/host/elf_file.h"
#include "plugins/host/text.h"
#include "plugins/host/trial.h"
#include "pomona/engine.h"
#include "pomona/plugin_host.h"
#include "sgm/kernels.h"

namespace pomona {
namespace {

using Library = std::unique_ptr<void, int (*)(void*)>;
using Plugin = std::unique_ptr<SparseStereoPlugin, void (*)(SparseStereoPlugin*)>;

[[noreturn]] void refuse(const std::string& subject, std::string reason) {
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  throw std::runtime_error(subject + ": " + reason);
}

/// Calls `step`; whatever it throws leaves as a std::runtime_error "subject: reason" that holds nothing of
/// the plugin's.
template <typename Step>
auto guarded(const std::string& subject, Step&& step) {
  try {
    return step();
  } catch (const std::exception& e) {
    refuse(subject, e.what());
  } catch (...) {
    refuse(subject, "the plugin threw something that is no std::exception");
  }
}

Library open(const std::string& path) {
  const std::string absolute = std::filesystem::absolute(path).string();  // else dlopen() might search for it
  Library library(dlopen(absolute.c_str(), RTLD_NOW | RTLD_LOCAL), dlclose);
  if (library) return library;
  std::string reason = dlerror();
  if (reason.starts_with(absolute + ": ")) reason.erase(0, absolute.size() + 2);
  refuse(path, reason);
}

const PluginEntry& entryOf(const std::string& path, void* library) {
  using EntryFunction = const PluginEntry* (*)();
  const auto function = reinterpret_cast<EntryFunction>(dlsym(library, "pomona_plugin_entry"));
  if (!function) refuse(path, "not a plugin: it has no symbol pomona_plugin_entry");
  const PluginEntry* const entry = guarded(path, [&] { return function(); });
  if (!entry) refuse(path, "not a plugin: pomona_plugin_entry() gave nothing");
  if (entry->abi_version != kPluginAbiVersion)
    refuse(path, "built for plugin interface " + std::to_string(entry->abi_version) + "; this Pomona has " +
                     std::to_string(kPluginAbiVersion));
  if (std::string_view(entry->built_with) != pluginBuildTag())
    refuse(path, std::string("built with ") + entry->built_with + "; this Pomona with " + pluginBuildTag());
  if (entry->struct_bytes != pluginStructBytes())
    refuse(path, "built with compiler options that change the layout of structs");
  return *entry;
}

StereoResult denseMap(const cv::Mat& left, const cv::Mat& right, const StereoCalibration& calibration,
                      const PluginRunOptions& run_options) {
  Options options = Options::preset("balanced");
  options.threads = run_options.threads;
  const int most = std::min(kMaxDisparities, left.cols);
  options.num_disparities = calibration.num_disparities > 0
                                ? std::min(calibration.num_disparities, most)
                                : estimateNumDisparities(left, right, options, run_options.mask);
  return computeDisparity(left, right, options, run_options.mask);
}

}  // namespace

struct LoadedPlugin::State {
  std::string path;
  Library library;  // before what lives in it: destroyed last
  Plugin plugin;
  std::string name, description;
  std::vector<PluginParameter> parameters;
  std::vector<ParameterSet> sets;
};

std::unique_ptr<LoadedPlugin::State> LoadedPlugin::load(const std::string& path) {
  Library library = open(path);
  const PluginEntry& entry = entryOf(path, library.get());
  return guarded(path, [&] {
    Plugin plugin(entry.create(), entry.destroy);
    if (!plugin) throw std::runtime_error("the plugin could not be made");
    auto state = std::make_unique<State>(State{path, std::move(library), std::move(plugin), {}, {}, {}, {}});
    state->name = state->plugin->name();
    state->description = state->plugin->description();
    state->parameters = state->plugin->parameters();
    state->sets = state->plugin->parameterSets();
    if (!isPlainName(state->name, '-'))
      throw std::runtime_error("the plugin's name is '" + state->name +
                               "'; allowed: lower-case letters, digits and hyphens");
    PluginSettings(state->name, state->parameters, state->sets);  // throws if they contradict themselves
    return state;
  });
}

// An exception that leaves the constructor of a static object passes the dynamic loader, and that ends the
// program; so does a crash. So it is tried first.
LoadedPlugin::LoadedPlugin(const std::string& path) {
  requireWholeLibrary(path);
  if (const std::string death = deathBy([&] { load(path); }); !death.empty())
    refuse(path, "ends the program as it is loaded, " + death);
  state_ = load(path);
}

LoadedPlugin::~LoadedPlugin() = default;
LoadedPlugin::LoadedPlugin(LoadedPlugin&&) noexcept = default;
LoadedPlugin& LoadedPlugin::operator=(LoadedPlugin&&) noexcept = default;

const std::string& LoadedPlugin::path() const {
  return state_->path;
}
const std::string& LoadedPlugin::name() const {
  return state_->name;
}
const std::string& LoadedPlugin::description() const {
  return state_->description;
}
const std::vector<PluginParameter>& LoadedPlugin::parameters() const {
  return state_->parameters;
}
const std::vector<ParameterSet>& LoadedPlugin::parameterSets() const {
  return state_->sets;
}
PluginSettings LoadedPlugin::settings() const {
  return {state_->name, state_->parameters, state_->sets};
}

SparseResult LoadedPlugin::run(const cv::Mat& left, const cv::Mat& right,
                               const StereoCalibration& calibration, const PluginSettings& settings,
                               const PluginRunOptions& options) {
  checkPluginInputs(left, right, calibration, options.mask);
  std::optional<StereoResult> map;
  const auto dense = [&]() -> const StereoResult& {
    if (!map) map = options.dense ? options.dense() : denseMap(left, right, calibration, options);
    return *map;
  };
  return guarded(name(), [&] {
    const PluginInputs inputs{settings, options.mask, dense, options.threads};
    SparseResult result = state_->plugin->run({left, right}, calibration, inputs);
    checkSparseResult(result);
    return result;
  });
}

}  // namespace pomona
