#include "plugins/host/text.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace pomona {

bool isPlainName(std::string_view name, char separator) {
  const auto isLetter = [](char c) { return 'a' <= c && c <= 'z'; };
  const auto isPlain = [&](char c) { return isLetter(c) || ('0' <= c && c <= '9') || c == separator; };
  return !name.empty() && isLetter(name.front()) && std::all_of(name.begin(), name.end(), isPlain);
}

std::string shortNumber(double number) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
  return {text.data(), end};
}

}  // namespace pomona
