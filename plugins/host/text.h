// Names and numbers as plugins declare and people read them.
#pragma once

#include <string>
#include <string_view>

namespace pomona {

/// Lower-case letters, digits and `separator`, beginning with a letter.
bool isPlainName(std::string_view name, char separator);

/// The shortest text that reads back as `number`: "0.7", "100", "1e-09".
std::string shortNumber(double number);

}  // namespace pomona
