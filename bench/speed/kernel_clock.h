// Times kernels where they work: inside the stage that calls them, on its data.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pomona {

/// Time and calls of one kernel, on one thread.
struct KernelTime {
  const char* name;
  std::int64_t nanoseconds = 0, calls = 0;
};

/// Of every kernel that timed() has wrapped.
inline std::vector<KernelTime*>& kernelTimes() {
  static std::vector<KernelTime*> all;
  return all;
}

template <std::size_t kSize>
struct KernelName {
  char text[kSize];
  constexpr KernelName(const char (&name)[kSize]) { std::copy_n(name, kSize, text); }
};

template <KernelName kName, typename Result, typename... Args>
struct TimedKernel {
  static inline Result (*kernel)(Args...);
  static inline KernelTime time{kName.text};

  static Result call(Args... args) {
    struct Lap {
      std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
      ~Lap() {
        const auto spent = std::chrono::steady_clock::now() - begin;
        time.nanoseconds += std::chrono::nanoseconds(spent).count();
        ++time.calls;
      }
    } lap;
    return kernel(args...);
  }
};

/// A function that does what `kernel` does and adds its time to the KernelTime of that name. One kernel per
/// name and signature at a time.
template <KernelName kName, typename Result, typename... Args>
Result (*timed(Result (*kernel)(Args...)))(Args...) {
  using Timed = TimedKernel<kName, Result, Args...>;
  auto& all = kernelTimes();
  if (std::find(all.begin(), all.end(), &Timed::time) == all.end()) all.push_back(&Timed::time);
  Timed::kernel = kernel;
  return Timed::call;
}

}  // namespace pomona
