// The parameters by which a plugin is told what to recognise.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugins/common/object_database.h"
#include "pomona/plugin_settings.h"

namespace pomona {

/// Opens the objects that settings name, and keeps them for the next run, until the files change.
class KnownObjects {
 public:
  /// objects, features, views, picture_sensitivity, save_objects. `views`: the default, "wide" (as if turned
  /// by up to 60 degrees, too) or "frontal". Pictures are learned with their fainter features by default.
  static std::vector<PluginParameter> parameters(const std::string& views);
  /// What makes them those of a published method: one view, `features` (SIFT where this build lacks them).
  static std::vector<std::pair<std::string, std::string>> faithful(const std::string& features);
  /// What people are to know of that: "by surf-64", or that this build has SIFT in its place.
  static std::string faithfulFeatures(const std::string& features);

  /// Throws as openObjects() does, and std::runtime_error if save_objects cannot be written.
  const ObjectDatabase& open(const PluginSettings& settings);

 private:
  std::string opened_;
  ObjectDatabase database_;
};

}  // namespace pomona
