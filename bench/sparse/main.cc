// Makes the tables of the sparse-feature modes again.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "bench/sparse/tables.h"
#include "datasets/atomic_file.h"

namespace pomona {
namespace {

struct Table {
  const char* name;
  void (*write)(std::ostream&, const SparseTableOptions&);
};
constexpr Table kTables[] = {{"region-sift", writeRegionSiftTable},
                             {"sobel-sift", writeSobelSiftTable},
                             {"segment-recognition", writeSegmentRecognitionTable},
                             {"logo-range", writeLogoRangeTable},
                             {"other-signs", writeOtherSignsTable},
                             {"real-queries", writeRealQueryTable}};

std::vector<std::string> tableNames() {
  std::vector<std::string> names;
  for (const Table& table : kTables) names.emplace_back(table.name);
  return names;
}

}  // namespace
}  // namespace pomona

int main(int argc, char** argv) {
  CLI::App app("Tables of the sparse-feature modes, on rendered scenes and real ones");
  pomona::SparseTableOptions options;
  std::vector<std::string> wanted = pomona::tableNames();
  std::string markdown;
  app.add_option("tables", wanted, "Which (default: all)")->check(CLI::IsMember(pomona::tableNames()));
  app.add_option("--scenes", options.scenes, "Folder of real pairs with ground truth")
      ->envname("POMONA_DATASETS");
  app.add_option("--pictures", options.pictures, "Existing folder for pictures");
  app.add_option("--repetitions", options.repetitions, "Of what is timed (default 5)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--markdown", markdown, "File for the tables; default: standard output");
  CLI11_PARSE(app, argc, argv);
  try {
    std::ostringstream text;
    for (const pomona::Table& table : pomona::kTables)
      if (std::find(wanted.begin(), wanted.end(), table.name) != wanted.end()) table.write(text, options);
    if (markdown.empty())
      std::cout << text.str();
    else
      pomona::writeFile(markdown, text.str());
  } catch (const std::exception& e) {
    std::cerr << "pomona_sparse: error: " << e.what() << '\n';
    return 1;
  }
}
