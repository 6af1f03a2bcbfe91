#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "apps/verbs.h"
#include "core/cpu.h"
#include "core/parallel.h"

namespace pomona {
namespace {

std::string listed(const std::vector<Isa>& isas) {
  std::string text;
  for (const Isa isa : isas) text += (text.empty() ? "" : ", ") + std::string(name(isa));
  return text;
}

void printInfo() {
  const Isa chosen = chooseIsa("");
  std::cout << "version                " << POMONA_VERSION << '\n'
            << "CPU                    " << cpuModel() << '\n'
            << "instruction sets built " << listed(builtIsas()) << '\n'
            << "of these usable here   " << listed(usableIsas()) << '\n'
            << "chosen                 " << name(chosen) << '\n'
            << "threads                " << availableThreads() << '\n';
}

}  // namespace

void addInfo(CLI::App& app) {
  app.add_subcommand("info", "Show the version, the CPU, instruction sets and threads")->callback(printInfo);
}

}  // namespace pomona
