#include "core/parallel.h"

#include <omp.h>

#include <atomic>

namespace pomona {
namespace {

struct Job {
  FunctionRef<void(int)> task;
  int count;
  std::atomic<int> next{0};
  std::atomic<int> finished{0};
};

// Takes tasks until none is left. The release/acquire pair on `finished` is what makes the results of all
// tasks visible to the caller without relying on the OpenMP runtime's own (uninstrumented) barrier.
void drain(Job& job) {
  for (int i; (i = job.next.fetch_add(1, std::memory_order_acq_rel)) < job.count;) job.task(i);
  job.finished.fetch_add(1, std::memory_order_acq_rel);
}

// libgomp is not instrumented, so ThreadSanitizer cannot see that its fork orders the caller's writes before
// the workers' first read of the region's arguments; only that hand-over is exempt from it, the tasks are
// not.
__attribute__((no_sanitize("thread"), noinline)) void fork(int threads, Job& job) {
#pragma omp parallel num_threads(threads) default(none) shared(job)
  drain(job);
}

}  // namespace

void parallelFor(int threads, int count, FunctionRef<void(int)> task) {
  threads = std::min(threads, count);
  if (threads <= 1) {
    for (int i = 0; i < count; ++i) task(i);
    return;
  }
  Job job{task, count};
  job.next.store(0, std::memory_order_release);
  fork(threads, job);
  job.finished.load(std::memory_order_acquire);
}

void parallelStrips(int threads, int rows, int min_rows, FunctionRef<void(int, int)> task) {
  const int strips = std::clamp(rows / std::max(1, min_rows), 1, std::max(1, 4 * threads));
  if (threads <= 1 || strips == 1) {
    task(0, rows);
    return;
  }
  parallelFor(threads, strips, [&](int i) {
    const auto edge = [&](int k) { return static_cast<int>(static_cast<long long>(rows) * k / strips); };
    task(edge(i), edge(i + 1));
  });
}

int availableThreads() {
  return std::max(1, omp_get_num_procs());
}

}  // namespace pomona
