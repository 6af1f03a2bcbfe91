#include "apps/print.h"

#include <array>
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

}  // namespace pomona
