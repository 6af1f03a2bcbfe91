// The tables of the sparse-feature modes, each in a file of its own.
#pragma once

#include <ostream>
#include <string>

namespace pomona {

struct SparseTableOptions {
  std::string scenes;    ///< folder of real pairs with truth; empty: rendered ones only
  std::string pictures;  ///< folder for pictures; empty: none
  int repetitions = 5;   ///< of what is timed; the median counts
};

/// Each writes one section in Markdown.
void writeRegionSiftTable(std::ostream& out, const SparseTableOptions& options);
void writeSobelSiftTable(std::ostream& out, const SparseTableOptions& options);
void writeSegmentRecognitionTable(std::ostream& out, const SparseTableOptions& options);
void writeLogoRangeTable(std::ostream& out, const SparseTableOptions& options);
void writeOtherSignsTable(std::ostream& out, const SparseTableOptions& options);
void writeRealQueryTable(std::ostream& out, const SparseTableOptions& options);

}  // namespace pomona
