#include "datasets/input_file.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

namespace pomona {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

[[noreturn]] void failToRead(const std::string& path, int error) {
  throw std::runtime_error(path + ": cannot be read: " + std::strerror(error));
}

template <typename T>
bool parseWhole(std::string_view text, T& value) {
  if (text.starts_with('+')) text.remove_prefix(1);  // from_chars knows no plus sign
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::string readFile(const std::string& path) {
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) failToRead(path, errno);
  std::string bytes;
  std::vector<char> block(1 << 20);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
    bytes.append(block.data(), count);
    if (bytes.size() > kMaxFileBytes)
      throw std::runtime_error(path + ": is larger than " + std::to_string(kMaxFileBytes) + " bytes");
  }
  if (std::ferror(file.get())) failToRead(path, errno);
  return bytes;
}

void failAtByte(const std::string& path, std::size_t byte, const std::string& message) {
  throw std::runtime_error(path + ": byte " + std::to_string(byte) + ": " + message);
}

void failAtLine(const std::string& path, int line, const std::string& message) {
  throw std::runtime_error(path + ": line " + std::to_string(line) + ": " + message);
}

std::string quoted(std::string_view text) {
  if (text.empty()) return "nothing";
  constexpr std::size_t kReadable = 40;
  std::string shown(text.substr(0, kReadable));
  for (char& c : shown)
    if (c < 0x20 || c > 0x7e) c = '?';
  return "'" + shown + (text.size() > kReadable ? "...'" : "'");
}

std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

bool parseNumber(std::string_view text, double& value) {
  return parseWhole(text, value);
}
bool parseNumber(std::string_view text, int& value) {
  return parseWhole(text, value);
}

std::string numberText(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string extensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

}  // namespace pomona
