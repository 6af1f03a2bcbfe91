// Markdown tables of figures.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "bench/accuracy/figures.h"

namespace pomona {

/// With as many decimals as the figure deserves; "-" for NaN.
std::string number(double value, Figure figure);

/// A line of the table.
void addRow(std::ostream& out, const std::vector<std::string>& cells);
/// The first column is text, the others are aligned to the right.
void addHeader(std::ostream& out, const std::vector<std::string>& cells);

}  // namespace pomona
