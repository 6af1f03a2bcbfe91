// The one place that starts threads. Results never depend on how many there are.
#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>

namespace pomona {

/// A borrowed callable: no allocation, no ownership.
template <typename Signature>
class FunctionRef;
template <typename R, typename... Args>
class FunctionRef<R(Args...)> {
 public:
  template <typename F>
  requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef>) FunctionRef(
      F&& f)  // NOLINT(google-explicit-constructor): made at the call site, like a function pointer
      : object_(const_cast<void*>(static_cast<const void*>(std::addressof(f)))),
        call_([](void* o, Args... a) -> R { return (*static_cast<std::remove_reference_t<F>*>(o))(a...); }) {}
  R operator()(Args... a) const { return call_(object_, a...); }

 private:
  void* object_;
  R (*call_)(void*, Args...);
};

/// Calls `task(i)` for every i in [0, count), on up to `threads` threads; returns when all are done.
/// Tasks are handed out in order. If one throws, no further ones are begun, and the exception comes out here.
/// `threads` <= 1 runs them here, one after the other.
void parallelFor(int threads, int count, FunctionRef<void(int)> task);

/// How far a task has come, for others that follow it. Those who wait sleep.
struct TaskProgress {
  int reached = 0;

  /// What was written before is seen by those whom it lets go on. Rises only.
  void reach(int value);
  void await(int value);
};

/// Cuts `rows` into strips of at least `min_rows` (a few per thread) and calls `task(begin, end)` for each.
void parallelStrips(int threads, int rows, int min_rows, FunctionRef<void(int, int)> task);

/// Processors this process may run on, at least 1.
int availableThreads();

}  // namespace pomona
