#include "pomona/plugin_host.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <stdexcept>

namespace pomona {
namespace {

namespace fs = std::filesystem;

/// The nearest folder above the program that CMake builds in; empty if there is none.
fs::path buildTreeOf(const fs::path& program) {
  std::error_code error;
  for (fs::path folder = program.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
    if (fs::exists(folder / "CMakeCache.txt", error)) return folder;
  return {};
}

std::vector<fs::path> filesIn(const std::string& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".so") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string withoutPath(const std::string& message, const std::string& path) {
  return message.starts_with(path + ": ") ? message.substr(path.size() + 2) : message;
}

}  // namespace

std::vector<std::string> pluginFolders() {
  std::vector<std::string> folders;
  const char* const listed = std::getenv("POMONA_PLUGIN_PATH");
  std::string rest = listed ? listed : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) folders.push_back(rest.substr(0, end));
    rest.erase(0, end + 1);
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  std::vector<fs::path> own{program.parent_path() / POMONA_PLUGINS_FROM_BIN};
  if (const fs::path tree = buildTreeOf(program); !tree.empty()) own.push_back(tree / "plugins");
  own.emplace_back(POMONA_PLUGINS_INSTALLED);
  const auto there =
      std::find_if(own.begin(), own.end(), [&](const fs::path& p) { return fs::is_directory(p, error); });
  if (there != own.end()) folders.push_back(there->lexically_normal().string());
  return folders;
}

PluginHost::PluginHost(const std::vector<std::string>& folders) {
  std::set<fs::path> seen;
  for (const std::string& folder : folders) {
    try {
      for (const fs::path& file : filesIn(folder)) {
        std::error_code error;
        if (seen.insert(fs::weakly_canonical(file, error)).second) load(file.string());
      }
    } catch (const fs::filesystem_error& e) {
      refused_.push_back({folder, e.code().message()});
    }
  }
  std::sort(plugins_.begin(), plugins_.end(),
            [](const LoadedPlugin& a, const LoadedPlugin& b) { return a.name() < b.name(); });
}

void PluginHost::load(const std::string& path) {
  try {
    LoadedPlugin loaded(path);
    for (const LoadedPlugin& other : plugins_)
      if (other.name() == loaded.name()) {
        refused_.push_back({path, "another plugin is called '" + loaded.name() + "': " + other.path()});
        return;
      }
    plugins_.push_back(std::move(loaded));
  } catch (const std::runtime_error& e) {
    refused_.push_back({path, withoutPath(e.what(), path)});
  }
}

LoadedPlugin& PluginHost::plugin(std::string_view name) {
  std::string names;
  for (LoadedPlugin& plugin : plugins_) {
    if (plugin.name() == name) return plugin;
    names += (names.empty() ? "" : ", ") + plugin.name();
  }
  throw std::invalid_argument("plugin is '" + std::string(name) +
                              "'; allowed: " + (names.empty() ? "none was found" : names));
}

}  // namespace pomona
