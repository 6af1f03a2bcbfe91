// Lines of text for people.
#pragma once

#include <string>
#include <vector>

namespace pomona {

/// A line on the standard output, of at most 511 characters; `format` as for printf.
[[gnu::format(printf, 1, 2)]] void print(const char* format, ...);

/// "a, b, c".
std::string listText(const std::vector<std::string>& names);

/// An angle without its sign: "20.80 deg left" for -20.8 with `positive` "right" and `negative` "left".
std::string angleText(double degrees, const char* positive, const char* negative);

}  // namespace pomona
