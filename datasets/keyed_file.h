// Text files of one "key, separator, values" per line, as Middlebury and KITTI keep their calibrations.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "datasets/input_file.h"

namespace pomona {

/// The lines of such a file. Everything that is wrong is thrown as std::runtime_error "path: line N: ...".
class KeyedFile {
 public:
  KeyedFile(std::string path, std::string text, char separator);
  KeyedFile(const KeyedFile&) = delete;  // the entries point into the text
  KeyedFile& operator=(const KeyedFile&) = delete;

  const std::string& path() const { return path_; }
  bool has(std::string_view key) const { return entries_.contains(key); }
  /// Throws unless there is a line for `key`; the functions below take that for granted.
  void require(std::string_view key) const;
  std::string_view text(std::string_view key) const { return entries_.find(key)->second.text; }

  double number(std::string_view key, double smallest, double largest) const;
  int number(std::string_view key, int smallest, int largest) const;
  /// Fills `values` with exactly as many finite numbers, separated by blanks; `allowed` describes them.
  void numbers(std::string_view key, std::span<double> values, const std::string& allowed) const;

  [[noreturn]] void fail(std::string_view key, const std::string& allowed) const;

 private:
  struct Entry {
    int line;
    std::string_view text;
  };
  void addLine(int line, std::string_view text);

  std::string path_;
  std::string text_;
  char separator_;
  std::map<std::string_view, Entry> entries_;
  int last_line_ = 1;
};

/// The finite numbers in `text`, separated by any of `separators`; false unless exactly `values.size()`.
bool parseNumbers(std::string_view text, std::string_view separators, std::span<double> values);

}  // namespace pomona
