// `pomona plugins`: which there are, and what can be set.
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "apps/verbs.h"
#include "datasets/input_file.h"
#include "pomona/plugin_host.h"

namespace pomona {
namespace {

void printPlugin(const LoadedPlugin& plugin) {
  std::cout << plugin.name() << ": " << printable(plugin.description()) << '\n'
            << "  " << plugin.path() << '\n';
  for (const PluginParameter& parameter : plugin.parameters())
    std::cout << "  " << parameter.name << " = " << printable(parameter.default_value) << "  ("
              << allowedValues(parameter) << ")  " << printable(parameter.description) << '\n';
  for (const ParameterSet& set : plugin.parameterSets()) {
    std::cout << "  variant = " << set.name << "  " << printable(set.description) << ":";
    for (const auto& [name, value] : set.values) std::cout << ' ' << name << '=' << printable(value);
    std::cout << '\n';
  }
}

void printPlugins() {
  const std::vector<std::string> folders = pluginFolders();
  PluginHost host(folders);
  for (const LoadedPlugin& plugin : host.plugins()) printPlugin(plugin);
  for (const auto& [path, reason] : host.refused())
    std::cout << "not loaded: " << path << ": " << printable(reason) << '\n';
  if (!host.plugins().empty()) return;
  std::cout << "no plugins found; looked in:";
  for (const std::string& folder : folders) std::cout << ' ' << folder;
  std::cout << (folders.empty() ? " no folder (see POMONA_PLUGIN_PATH)\n" : "\n");
}

}  // namespace

void addPlugins(CLI::App& app) {
  app.add_subcommand("plugins", "List the sparse-feature modes with their parameters")
      ->callback(printPlugins);
}

}  // namespace pomona
