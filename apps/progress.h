// A progress bar for people who watch.
#pragma once

#include <chrono>
#include <string>

namespace pomona {

/// One line on the error stream that is written over and over; nothing at all unless that is a terminal.
class Progress {
 public:
  explicit Progress(int steps);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Says what is under way now.
  void show(const std::string& what);
  void stepsDone(int count) { done_ += count; }
  /// Makes room for other output; the next show() brings the bar back.
  void clear();

 private:
  bool watched_;
  int steps_, done_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace pomona
