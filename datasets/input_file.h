// Reading whole files, and saying precisely what is wrong with them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pomona {

/// The file's bytes. Throws std::runtime_error "path: reason" if it cannot be read or exceeds kMaxFileBytes.
std::string readFile(const std::string& path);
inline constexpr std::size_t kMaxFileBytes = (std::size_t{1} << 31) + (std::size_t{1} << 16);

/// Throws std::runtime_error "path: byte N: message".
[[noreturn]] void failAtByte(const std::string& path, std::size_t byte, const std::string& message);
/// Throws std::runtime_error "path: line N: message"; lines count from 1.
[[noreturn]] void failAtLine(const std::string& path, int line, const std::string& message);

/// `text` in quotes, cut to a readable length and with unprintable bytes shown as '?'; for an empty text
/// "nothing".
std::string quoted(std::string_view text);

/// `text` with control characters shown as '?', for names and messages that people read.
std::string printable(std::string text);

/// Parses the whole of `text` as a number in the C locale's notation; false if it is anything else.
bool parseNumber(std::string_view text, double& value);
bool parseNumber(std::string_view text, int& value);
/// The inverse: the shortest text that reads back as the same number.
std::string numberText(double value);

/// The file name's extension in lower case with its dot (".pfm"), or empty.
std::string extensionOf(const std::string& path);

}  // namespace pomona
