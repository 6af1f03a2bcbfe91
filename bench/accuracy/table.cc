#include "bench/accuracy/table.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace pomona {

std::string number(double value, Figure figure) {
  if (std::isnan(value)) return "-";
  const bool fine = figure == kInlierBias || figure == kInlierRms;
  std::ostringstream out;
  out << std::fixed << std::setprecision(fine ? 3 : 2) << value;
  return out.str();
}

void addRow(std::ostream& out, const std::vector<std::string>& cells) {
  out << "|";
  for (const std::string& cell : cells) out << " " << cell << " |";
  out << "\n";
}

void addHeader(std::ostream& out, const std::vector<std::string>& cells) {
  addRow(out, cells);
  out << "|---|";
  for (std::size_t i = 1; i < cells.size(); ++i) out << "--:|";
  out << "\n";
}

}  // namespace pomona
