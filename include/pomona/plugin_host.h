// How a program finds and runs plugins (pomona/plugin.h says how to write one).
#pragma once

#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "pomona/plugin.h"

namespace pomona {

/// What a plugin may be given beside the pair; all of it may be left out.
struct PluginRunOptions {
  cv::Mat mask;  ///< see PluginInputs
  /// Computes the dense map; by default the preset `balanced` does, over the calibration's num_disparities or
  /// an estimate. Called at most once.
  std::function<StereoResult()> dense;
  int threads = 0;
};

/// A plugin that was loaded. Holds the file open for as long as it lives. One thread at a time.
class LoadedPlugin {
 public:
  /// Throws std::runtime_error "path: reason" for a file that is no plugin, was built for another version,
  /// whose plugin throws when it is made or declares nonsense, or that would end the program as it is loaded,
  /// which is tried in a forked child first.
  explicit LoadedPlugin(const std::string& path);
  ~LoadedPlugin();
  LoadedPlugin(LoadedPlugin&&) noexcept;
  LoadedPlugin& operator=(LoadedPlugin&&) noexcept;

  const std::string& path() const;
  const std::string& name() const;
  const std::string& description() const;
  const std::vector<PluginParameter>& parameters() const;
  const std::vector<ParameterSet>& parameterSets() const;
  /// The defaults, to be changed.
  PluginSettings settings() const;

  /// `left`, `right`: rectified, of one size, CV_8U with 1 or 3 channels. Throws std::invalid_argument for
  /// views, a mask or a calibration that no plugin could use, and std::runtime_error "name: reason" for
  /// whatever the plugin throws, and for a result that contradicts itself.
  SparseResult run(const cv::Mat& left, const cv::Mat& right, const StereoCalibration& calibration,
                   const PluginSettings& settings, const PluginRunOptions& options = {});

 private:
  struct State;
  static std::unique_ptr<State> load(const std::string& path);

  std::unique_ptr<State> state_;
};

/// Where plugins are looked for: the folders that the environment variable POMONA_PLUGIN_PATH names
/// (separated by colons), then the first of these that exists: lib/pomona/plugins of the installation the
/// program is in; plugins/ of the build tree it is in; lib/pomona/plugins of the installation Pomona was
/// configured for.
std::vector<std::string> pluginFolders();

/// All plugins of some folders: files whose names end in ".so".
class PluginHost {
 public:
  /// A file (or a folder named by POMONA_PLUGIN_PATH) that cannot be used.
  struct Refused {
    std::string path, reason;
  };

  /// Never throws for what is in the folders: see refused(). Of two plugins of one name, the first counts.
  explicit PluginHost(const std::vector<std::string>& folders = pluginFolders());

  /// In alphabetical order.
  std::vector<LoadedPlugin>& plugins() { return plugins_; }
  const std::vector<Refused>& refused() const { return refused_; }
  /// Throws std::invalid_argument naming those there are.
  LoadedPlugin& plugin(std::string_view name);

 private:
  void load(const std::string& path);

  std::vector<LoadedPlugin> plugins_;
  std::vector<Refused> refused_;
};

}  // namespace pomona
