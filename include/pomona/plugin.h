// How to write a plugin: a way of finding sparse points and objects in a stereo pair, in a file of its own
// that programs load at run time (pomona/plugin_host.h; docs/plugins.md; examples/plugin).
#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "pomona/calibration.h"
#include "pomona/disparity.h"
#include "pomona/plugin_settings.h"
#include "pomona/sparse_result.h"

namespace pomona {

/// Rectified views of one size and type: CV_8U with 1 or 3 channels (BGR). They may share memory with the
/// caller's: plugins don't write to them.
struct RectifiedPair {
  cv::Mat left, right;
};

struct PluginInputs {
  const PluginSettings& settings;
  /// Empty, or CV_8U of the views' size: pixels of the left view that are 0 are not to be used.
  cv::Mat mask;
  /// The engine's dense map of the pair. Computed at the first call, which takes its time; it lasts until
  /// run() returns.
  std::function<const StereoResult&()> dense;
  int threads = 0;  ///< to use at most; 0: all there are
};

/// One way of sparse stereo. A plugin's file defines one subclass with a default constructor and ends with
/// POMONA_PLUGIN(ThatClass). One object serves one thread at a time and may keep things between runs, as long
/// as equal inputs give equal results.
class SparseStereoPlugin {
 public:
  virtual ~SparseStereoPlugin() = default;

  /// Lower-case letters, digits and hyphens, e.g. "region-sift".
  virtual std::string name() const = 0;
  /// One line.
  virtual std::string description() const = 0;
  virtual std::vector<PluginParameter> parameters() const { return {}; }
  /// Alternatives to the defaults, e.g. a published method's values under the name "faithful".
  virtual std::vector<ParameterSet> parameterSets() const { return {}; }

  /// That nothing was found is a result (SparseObject::why_not), not an error. Throws std::invalid_argument
  /// or std::runtime_error, with one line of text, for inputs and files it cannot use.
  virtual SparseResult run(const RectifiedPair& pair, const StereoCalibration& rig,
                           const PluginInputs& inputs) = 0;
};

/// Raised with every change of what this file declares or includes.
inline constexpr std::uint32_t kPluginAbiVersion = 1;

/// What a plugin's file hands out, as the C function pomona_plugin_entry(). The first member keeps its place
/// for ever: it says whether the others can be believed.
struct PluginEntry {
  std::uint32_t abi_version;
  const char* built_with;      ///< pluginBuildTag() as it was when the plugin was compiled
  std::uint32_t struct_bytes;  ///< pluginStructBytes(), likewise
  SparseStereoPlugin* (*create)();
  void (*destroy)(SparseStereoPlugin*);
};

#define POMONA_TEXT_OF(macro) POMONA_QUOTED(macro)
#define POMONA_QUOTED(text) #text

/// What both sides must have in common for their classes to have one layout.
constexpr const char* pluginBuildTag() {
  return "C++ ABI " POMONA_TEXT_OF(__GXX_ABI_VERSION) ", OpenCV " POMONA_TEXT_OF(
      CV_VERSION_MAJOR) "." POMONA_TEXT_OF(CV_VERSION_MINOR);
}

/// Differs where compiler options changed a layout, e.g. -D_GLIBCXX_DEBUG.
constexpr std::uint32_t pluginStructBytes() {
  return sizeof(RectifiedPair) + sizeof(PluginInputs) + sizeof(PluginSettings) + sizeof(PluginParameter) +
         sizeof(ParameterSet) + sizeof(StereoCalibration) + sizeof(StereoResult) + sizeof(SparseResult) +
         sizeof(SparsePoint) + sizeof(SparseObject) + sizeof(SparseFigure) + sizeof(SparsePicture);
}

}  // namespace pomona

/// Makes this file a plugin: defines the one symbol that is looked for.
#define POMONA_PLUGIN(Class)                                                                               \
  extern "C" [[gnu::visibility("default")]] const pomona::PluginEntry* pomona_plugin_entry() {             \
    static constexpr pomona::PluginEntry entry{pomona::kPluginAbiVersion, pomona::pluginBuildTag(),        \
                                               pomona::pluginStructBytes(),                                \
                                               []() -> pomona::SparseStereoPlugin* { return new Class; },  \
                                               [](pomona::SparseStereoPlugin* plugin) { delete plugin; }}; \
    return &entry;                                                                                         \
  }
