#include "apps/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace pomona {

Progress::Progress(int steps) : watched_(::isatty(STDERR_FILENO) == 1), steps_(std::max(1, steps)) {}

void Progress::show(const std::string& what) {
  if (!watched_) return;
  constexpr int kWidth = 30;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
  const std::string bar(static_cast<std::size_t>(kWidth * done_ / steps_), '#');
  std::fprintf(stderr, "\r\033[K[%-*s] %d/%d", kWidth, bar.c_str(), done_, steps_);
  if (done_ > 0) std::fprintf(stderr, ", %.0f s left", elapsed.count() / done_ * (steps_ - done_));
  std::fprintf(stderr, "  %s", what.c_str());
  std::fflush(stderr);
}

void Progress::clear() {
  if (watched_) std::fputs("\r\033[K", stderr);
}

}  // namespace pomona
