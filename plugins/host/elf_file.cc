#include "plugins/host/elf_file.h"

#include <elf.h>
#include <link.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace pomona {

void requireWholeLibrary(const std::string& path) {
  const auto refuse = [&](const std::string& reason) { throw std::runtime_error(path + ": " + reason); };
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) refuse(error ? error.message() : "not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse("cannot be read");
  ElfW(Ehdr) header{};
  file.read(reinterpret_cast<char*>(&header), sizeof header);
  const int native = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  if (!file || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 || header.e_ident[EI_CLASS] != native ||
      header.e_phentsize != sizeof(ElfW(Phdr)))
    refuse("not a plugin: it is no shared library of this machine's kind");
  const auto size = std::filesystem::file_size(path, error);
  for (int i = 0; i < header.e_phnum; ++i) {
    ElfW(Phdr) segment{};
    file.seekg(static_cast<std::streamoff>(header.e_phoff + i * sizeof segment));
    file.read(reinterpret_cast<char*>(&segment), sizeof segment);
    if (!file || (segment.p_type == PT_LOAD && segment.p_offset + segment.p_filesz > size))
      refuse("not a plugin: the file ends at byte " + std::to_string(size) + ", before the library does");
  }
}

}  // namespace pomona
