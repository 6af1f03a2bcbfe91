#include "datasets/atomic_file.h"

#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <vector>

#include "file_support.h"

namespace pomona {
namespace {

namespace fs = std::filesystem;

TEST(WriteFile, WritesAndReplacesAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const std::string binary("a\0b\n\xff", 5);
  writeFile(folder / "a", binary);
  EXPECT_EQ(bytesOf(folder / "a"), binary);
  writeFile(folder / "a", "");
  EXPECT_EQ(bytesOf(folder / "a"), "");
  const std::string large(5 << 20, 'x');
  writeFile(folder / "a", large);
  EXPECT_EQ(bytesOf(folder / "a"), large);
  EXPECT_EQ(folder.fileCount(), 1);
}

TEST(WriteFile, HonoursTheUmask) {
  const TemporaryFolder folder;
  const mode_t old_mask = ::umask(027);
  writeFile(folder / "a", "text");
  ::umask(old_mask);
  EXPECT_EQ(fs::status(folder / "a").permissions(), static_cast<fs::perms>(0640));
}

TEST(WriteFile, FollowsSymbolicLinksAndTakesRelativeNames) {
  const TemporaryFolder folder;
  put(folder / "real", "old");
  fs::create_symlink(folder / "real", folder / "link");
  writeFile(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(bytesOf(folder / "real"), "new");

  const fs::path before = fs::current_path();
  fs::current_path(folder / ".");
  writeFile("bare", "text");
  fs::current_path(before);
  EXPECT_EQ(bytesOf(folder / "bare"), "text");
}

TEST(WriteFile, RefusesPlacesWhereNoFileCanBe) {
  const TemporaryFolder folder;
  put(folder / "file", "x");
  fs::create_directory(folder / "sub");
  const struct {
    std::string path, part;
  } cases[] = {
      {folder / "absent/a", "there is no folder"},
      {folder / "file/a", "there is no folder"},
      {folder / "sub", "not a regular file"},
      {"/dev/full", "not a regular file"},
      {"", "names no file"},
      {folder / "sub/", "names no file"},
      {folder / std::string(300, 'n'), "too long"},
  };
  for (const auto& c : cases) {
    const std::string message = messageOf([&] { writeFile(c.path, "bytes"); });
    expectContains(message, c.path + ": cannot be written: ");
    expectContains(message, c.part);
    EXPECT_EQ(folder.fileCount(), 2) << c.path;
  }
}

TEST(WriteFolder, MakesItOrSaysWhyNot) {
  const TemporaryFolder folder;
  put(folder / "file", "x");
  const OutputFile files[] = {{"a", "1"}, {"b", "2"}};
  for (const std::string& path : {folder / "new", folder / "new", folder / "newer/"}) {
    EXPECT_NO_THROW(checkOutputFolder(path));
    writeFolder(path, files);
    EXPECT_EQ(bytesOf(path + "/b"), "2");
  }
  for (const auto& [path, part] : {std::pair(folder / "file", "this is a file"),
                                   {"", "names no folder"},
                                   {folder / "absent/sub", "there is no folder"},
                                   {folder / "file/sub", "there is no folder"}}) {
    expectContains(messageOf([&] { checkOutputFolder(path); }), part);
    expectContains(messageOf([&] { writeFolder(path, files); }), part);
  }
  EXPECT_EQ(folder.fileCount(), 3);
}

TEST(WriteFiles, OneBadOutputMeansNoOutput) {
  const TemporaryFolder folder;
  put(folder / "kept", "old");
  for (const std::string& bad : {folder / "absent/b", folder / std::string(300, 'n')}) {
    const std::vector<OutputFile> files = {{folder / "a", "a"}, {folder / "kept", "new"}, {bad, "b"}};
    EXPECT_THROW(writeFiles(files), std::runtime_error);
    EXPECT_EQ(bytesOf(folder / "kept"), "old");
    EXPECT_EQ(folder.fileCount(), 1);
  }
}

// What a full disk does to write(), without needing one.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit old_{};
  void (*handler_)(int);
};

TEST(WriteFiles, RunningOutOfSpaceLeavesEverythingAsItWas) {
  const TemporaryFolder folder;
  put(folder / "old", "old");
  const std::vector<OutputFile> files = {{folder / "small", "a"}, {folder / "old", std::string(100000, 'x')}};
  std::string message;
  {
    const FileSizeLimit limit(50000);
    message = messageOf([&] { writeFiles(files); });
  }
  expectContains(message, (folder / "old") + ": cannot be written: File too large");
  EXPECT_EQ(bytesOf(folder / "old"), "old");
  EXPECT_EQ(folder.fileCount(), 1);
}

}  // namespace
}  // namespace pomona
