// Refusing options.
#pragma once

#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>

namespace pomona {

/// Throws std::invalid_argument "NAME is VALUE; allowed: SMALLEST to LARGEST" unless `value` lies between.
inline void requireRange(const std::string& name, double value, double smallest, double largest) {
  if (value >= smallest && value <= largest) return;
  std::ostringstream message;
  message.imbue(std::locale::classic());
  message << name << " is " << value << "; allowed: " << smallest << " to " << largest;
  throw std::invalid_argument(message.str());
}

}  // namespace pomona
