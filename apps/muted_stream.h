// Keeps foreign code from writing to the error stream.
#pragma once

#include <fcntl.h>
#include <unistd.h>

namespace pomona {

/// libpng and libjpeg write their complaints straight to the error stream, where only our own line belongs:
/// while an object of this class lives, nothing written there appears.
class MutedErrorStream {
 public:
  MutedErrorStream() : saved_(::dup(STDERR_FILENO)), nothing_(::open("/dev/null", O_WRONLY | O_CLOEXEC)) {
    if (saved_ >= 0 && nothing_ >= 0) ::dup2(nothing_, STDERR_FILENO);
  }
  ~MutedErrorStream() {
    if (saved_ >= 0 && nothing_ >= 0) ::dup2(saved_, STDERR_FILENO);
    if (saved_ >= 0) ::close(saved_);
    if (nothing_ >= 0) ::close(nothing_);
  }
  MutedErrorStream(const MutedErrorStream&) = delete;
  MutedErrorStream& operator=(const MutedErrorStream&) = delete;

 private:
  int saved_, nothing_;
};

}  // namespace pomona
