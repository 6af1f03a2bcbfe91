#include "apps/print.h"

#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <iostream>

namespace pomona {

void print(const char* format, ...) {
  std::array<char, 512> line;
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(line.data(), line.size(), format, values);
  va_end(values);
  std::cout << line.data() << '\n';
}

std::string listText(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::string angleText(double degrees, const char* positive, const char* negative) {
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.2f deg %s", std::abs(degrees),
                degrees < 0 ? negative : positive);
  return text.data();
}

}  // namespace pomona
