// Files that are either written completely or not at all.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pomona {

struct OutputFile {
  std::string path;
  std::string bytes;
};

/// Throws std::runtime_error unless a file can be expected to be written at `path`: its folder exists and is
/// writable, and nothing but a regular file stands in its place.
void checkOutputPath(const std::string& path);

/// Throws std::runtime_error unless writeFolder() can be expected to make or fill `folder`.
void checkOutputFolder(const std::string& folder);

/// Writes all of `files`, or none: everything goes to temporary names (".pomona-*.tmp") beside the targets
/// first, and is renamed only once all bytes are out. Existing files are replaced; symbolic links are
/// followed. Throws std::runtime_error "path: reason" after removing whatever it had written.
void writeFiles(std::span<const OutputFile> files);

void writeFile(const std::string& path, std::string_view bytes);

/// The same for `files` whose paths are names inside `folder`, which is made if it is not there, and goes
/// again if that fails.
void writeFolder(const std::string& folder, std::span<const OutputFile> files);

}  // namespace pomona
