#include "datasets/keyed_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pomona {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const std::size_t begin = text.find_first_not_of(kSpace);
  return begin == text.npos ? "" : text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

template <typename Number>
Number parseWithin(const KeyedFile& file, std::string_view key, Number smallest, Number largest) {
  Number value{};
  if (!parseNumber(file.text(key), value) || !(value >= smallest && value <= largest))
    file.fail(key, "a number from " + numberText(smallest) + " to " + numberText(largest));
  return value;
}

}  // namespace

KeyedFile::KeyedFile(std::string path, std::string text, char separator)
    : path_(std::move(path)), text_(std::move(text)), separator_(separator) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::string_view rest = text_;
  if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());
  int line = 1;
  for (; !rest.empty(); ++line) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    addLine(line, trimmed(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  last_line_ = std::max(1, line - 1);
}

void KeyedFile::addLine(int line, std::string_view text) {
  if (text.empty()) return;
  const std::size_t cut = text.find(separator_);
  if (cut == text.npos)
    failAtLine(path_, line, std::string("expected 'key") + separator_ + "value', found " + quoted(text));
  const std::string_view key = trimmed(text.substr(0, cut));
  if (!entries_.emplace(key, Entry{line, trimmed(text.substr(cut + 1))}).second)
    failAtLine(path_, line, "a second value for " + quoted(key));
}

void KeyedFile::require(std::string_view key) const {
  if (!has(key))
    failAtLine(path_, last_line_, "the file ends without '" + std::string(key) + separator_ + "'");
}

double KeyedFile::number(std::string_view key, double smallest, double largest) const {
  return parseWithin(*this, key, smallest, largest);
}
int KeyedFile::number(std::string_view key, int smallest, int largest) const {
  return parseWithin(*this, key, smallest, largest);
}

void KeyedFile::numbers(std::string_view key, std::span<double> values, const std::string& allowed) const {
  if (!parseNumbers(text(key), " \t", values)) fail(key, allowed);
}

void KeyedFile::fail(std::string_view key, const std::string& allowed) const {
  const Entry& entry = entries_.find(key)->second;
  failAtLine(path_, entry.line, std::string(key) + " is " + quoted(entry.text) + "; allowed: " + allowed);
}

bool parseNumbers(std::string_view text, std::string_view separators, std::span<double> values) {
  std::size_t count = 0;
  for (std::size_t begin = 0; (begin = text.find_first_not_of(separators, begin)) != text.npos; ++count) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    if (count == values.size() || !parseNumber(text.substr(begin, end - begin), values[count]) ||
        !std::isfinite(values[count]))
      return false;
    begin = end;
  }
  return count == values.size();
}

}  // namespace pomona
