#include "datasets/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <list>
#include <stdexcept>
#include <vector>

namespace pomona {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failToWrite(const std::string& path, const std::string& reason) {
  throw std::runtime_error(path + ": cannot be written: " + reason);
}

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Throws unless files can be made in `folder`; `path` is what is to be written there.
void requireWritable(const fs::path& folder, const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) failToWrite(path, "there is no folder '" + folder.string() + "'");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    failToWrite(path, "folder '" + folder.string() + "': " + std::strerror(errno));
}

// The bytes of one output under a temporary name; the name disappears with the object unless committed.
class Temporary {
 public:
  Temporary(const std::string& path, std::string_view bytes) : shown_path_(path), target_(path) {
    std::error_code error;
    if (fs::exists(target_, error)) target_ = fs::canonical(target_);
    create();
    write(bytes);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    if (!committed_) ::unlink(name_.c_str());
    if (replaces_) ::unlink(replacedName().c_str());
  }

  void commit() {
    replaces_ = ::link(target_.c_str(), replacedName().c_str()) == 0;
    if (std::rename(name_.c_str(), target_.c_str()) != 0) failToWrite(shown_path_, std::strerror(errno));
    committed_ = true;
  }
  void revert() {
    if (!committed_) return;
    if (replaces_)
      std::rename(replacedName().c_str(), target_.c_str());
    else
      ::unlink(target_.c_str());
  }

 private:
  // A second name for the file that the target replaces, until all is well.
  std::string replacedName() const { return name_.string() + ".old"; }

  void create() {
    static std::atomic<unsigned> counter{0};
    do {
      const std::string leaf =
          ".pomona-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp";
      name_ = folderOf(target_) / leaf;
      descriptor_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0) failToWrite(shown_path_, std::strerror(errno));
  }

  // Called by the constructor, so what it leaves behind when it fails is its own to remove.
  void write(std::string_view bytes) {
    int error = 0;
    while (!bytes.empty() && error == 0) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count >= 0)
        bytes.remove_prefix(static_cast<std::size_t>(count));
      else if (errno != EINTR)
        error = errno;
    }
    if (::close(descriptor_) != 0 && error == 0) error = errno;  // a full disk may show only here
    if (error == 0) return;
    ::unlink(name_.c_str());
    failToWrite(shown_path_, std::strerror(error));
  }

  std::string shown_path_;
  fs::path target_;
  fs::path name_;
  int descriptor_ = -1;
  bool committed_ = false;
  bool replaces_ = false;
};

}  // namespace

void checkOutputPath(const std::string& path) {
  std::error_code error;
  if (path.empty() || !fs::path(path).has_filename()) failToWrite(path, "this names no file");
  requireWritable(folderOf(path), path);
  if (fs::exists(path, error) && !fs::is_regular_file(path, error))
    failToWrite(path, "something that is not a regular file has this name");
}

void checkOutputFolder(const std::string& folder) {
  std::error_code error;
  if (folder.empty()) failToWrite("''", "this names no folder");
  if (!fs::exists(folder, error)) {
    const fs::path path(folder);  // "DIR/" has a parent DIR, which is itself
    requireWritable(folderOf(path.has_filename() ? path : path.parent_path()), folder);
  } else if (fs::is_directory(folder, error)) {
    requireWritable(folder, folder);
  } else {
    failToWrite(folder, "this is a file; allowed: a folder, or a new name");
  }
}

void writeFiles(std::span<const OutputFile> files) {
  for (const OutputFile& file : files) checkOutputPath(file.path);
  std::list<Temporary> temporaries;
  for (const OutputFile& file : files) temporaries.emplace_back(file.path, file.bytes);
  try {
    for (Temporary& temporary : temporaries) temporary.commit();
  } catch (...) {
    for (Temporary& temporary : temporaries) temporary.revert();
    throw;
  }
}

void writeFile(const std::string& path, std::string_view bytes) {
  const OutputFile file{path, std::string(bytes)};
  writeFiles({&file, 1});
}

void writeFolder(const std::string& folder, std::span<const OutputFile> files) {
  checkOutputFolder(folder);
  std::vector<OutputFile> inside;
  for (const OutputFile& file : files)
    inside.push_back({(fs::path(folder) / file.path).string(), file.bytes});
  std::error_code error;
  const bool created = fs::create_directory(folder, error);
  try {
    writeFiles(inside);
  } catch (...) {
    if (created) fs::remove(folder, error);
    throw;
  }
}

}  // namespace pomona
