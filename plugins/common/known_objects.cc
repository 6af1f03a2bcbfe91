#include "plugins/common/known_objects.h"

#include <algorithm>

namespace pomona {
namespace {

std::vector<std::string> featureNames() {
  std::vector<std::string> names;
  for (const FeatureKind kind : featureKinds()) names.emplace_back(nameOf(kind));
  std::swap(names[0], names[1]);  // root-sift, the better one, is the default
  return names;
}

}  // namespace

std::vector<PluginParameter> KnownObjects::parameters() {
  return {
      textParameter("objects", "A database (.objects), or pictures of the objects, separated by commas"),
      choiceParameter("features", "To learn pictures by; a database knows its own", featureNames()),
      choiceParameter("views", "To learn of each picture: as if turned by up to 60 degrees, or itself alone",
                      {"wide", "frontal"})};
}

std::vector<std::pair<std::string, std::string>> KnownObjects::faithful(const std::string& features) {
  const std::vector<std::string> names = featureNames();
  const bool known = std::find(names.begin(), names.end(), features) != names.end();
  return {{"features", known ? features : "sift"}, {"views", "frontal"}};
}

const ObjectDatabase& KnownObjects::open(const PluginSettings& settings) {
  const std::string& objects = settings.text("objects");
  const std::string key = objects + '\n' + settings.text("features") + '\n' + settings.text("views");
  if (key == opened_) return database_;
  TrainingOptions options;
  options.kind = featureKindOf(settings.text("features"));
  if (settings.text("views") == "wide") options.yaws_deg = wideYaws();
  database_ = openObjects(objects, options);
  opened_ = key;
  return database_;
}

}  // namespace pomona
