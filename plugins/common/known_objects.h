// The parameters by which a plugin is told what to recognise.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugins/common/object_database.h"
#include "pomona/plugin_settings.h"

namespace pomona {

/// Opens the objects that settings name, and keeps them for the next run.
class KnownObjects {
 public:
  /// objects, features, views.
  static std::vector<PluginParameter> parameters();
  /// What makes them those of a published method: one view, `features` (SIFT where this build lacks them).
  static std::vector<std::pair<std::string, std::string>> faithful(const std::string& features);

  /// Throws as openObjects() does.
  const ObjectDatabase& open(const PluginSettings& settings);

 private:
  std::string opened_;
  ObjectDatabase database_;
};

}  // namespace pomona
