#include "plugins/common/known_objects.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "datasets/atomic_file.h"
#include "datasets/input_file.h"

namespace pomona {
namespace {

std::vector<std::string> featureNames() {
  std::vector<std::string> names;
  for (const FeatureKind kind : featureKinds()) names.emplace_back(nameOf(kind));
  std::swap(names[0], names[1]);  // root-sift, the better one, is the default
  return names;
}

const std::string kSubstitute = "sift";

bool isKnown(const std::string& features) {
  const std::vector<std::string> names = featureNames();
  return std::find(names.begin(), names.end(), features) != names.end();
}

// Changes with the settings, and with the files that they name.
std::string keyOf(const PluginSettings& settings) {
  std::string key = std::to_string(settings.real("picture_sensitivity"));
  for (const char* name : {"features", "views", "save_objects"}) key += '\n' + settings.text(name);
  std::istringstream list(settings.text("objects"));
  for (std::string path; std::getline(list, path, ',');) {
    std::error_code error;
    key += '\n' + path + '\n' + std::to_string(std::filesystem::file_size(path, error)) + ' ' +
           std::to_string(std::filesystem::last_write_time(path, error).time_since_epoch().count());
  }
  return key;
}

}  // namespace

std::vector<PluginParameter> KnownObjects::parameters(const std::string& views) {
  const bool wide_first = views == "wide";  // the first choice is the default
  return {
      textParameter("objects", "A database (.objects), or pictures of the objects, separated by commas"),
      choiceParameter("features", "To learn pictures by; a database knows its own", featureNames()),
      choiceParameter("views", "To learn of each picture: as if turned by up to 60 degrees, or itself alone",
                      wide_first ? std::vector<std::string>{"wide", "frontal"}
                                 : std::vector<std::string>{"frontal", "wide"}),
      realParameter("picture_sensitivity", "Divides the contrast that features of pictures need", 2, 0.1, 20),
      textParameter("save_objects", "Database (.objects) to write what was learned to")};
}

std::vector<std::pair<std::string, std::string>> KnownObjects::faithful(const std::string& features) {
  return {{"features", isKnown(features) ? features : kSubstitute},
          {"views", "frontal"},
          {"picture_sensitivity", "1"}};
}

std::string KnownObjects::faithfulFeatures(const std::string& features) {
  if (isKnown(features)) return "by " + features;
  return "but by " + kSubstitute + " in place of " + features + ", which this build is without";
}

const ObjectDatabase& KnownObjects::open(const PluginSettings& settings) {
  const std::string& objects = settings.text("objects");
  const std::string key = keyOf(settings);
  if (key == opened_) return database_;
  TrainingOptions options;
  options.sensitivity = settings.real("picture_sensitivity");
  options.kind = featureKindOf(settings.text("features"));
  if (settings.text("views") == "wide") options.yaws_deg = wideYaws();
  database_ = openObjects(objects, options);
  if (const std::string& path = settings.text("save_objects"); !path.empty()) {
    if (extensionOf(path) != ".objects")
      throw std::invalid_argument("save_objects is '" + path + "'; allowed: a name that ends in .objects");
    writeFile(path, encodeObjectDatabase(database_));
  }
  opened_ = key;
  return database_;
}

}  // namespace pomona
