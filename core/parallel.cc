#include "core/parallel.h"

#include <sched.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace pomona {
namespace {

/// One call of parallelFor, on its caller's stack.
struct Job {
  FunctionRef<void(int)> task;
  int count;
  std::atomic<int> next{0};

  // Guarded by the pool's mutex.
  int wanted = 0;  // further threads that may join
  int active = 0;  // threads that have joined and not left
  Job* behind = nullptr;
  std::condition_variable left{};

  std::atomic<bool> failed{false};
  std::exception_ptr failure{};  // written by the one that set `failed`

  /// Takes tasks until none is left, or one has thrown.
  void drain() {
    try {
      for (int i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) task(i);
    } catch (...) {
      next.store(count, std::memory_order_relaxed);
      if (!failed.exchange(true)) failure = std::current_exception();
    }
  }
};

/// Threads that sleep until a job wants them. They are started once and shared by all engines; a caller
/// always works on its own job too, so it never depends on one of them being free.
class Pool {
 public:
  static Pool& instance() {
    static Pool pool;
    return pool;
  }

  void run(Job& job, int threads) {
    std::unique_lock lock(mutex_);
    try {
      while (static_cast<int>(workers_.size()) < threads - 1) workers_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {  // no further thread to be had: those there are will do
    }
    job.wanted = threads - 1;
    job.behind = jobs_;
    jobs_ = &job;
    lock.unlock();
    if (threads == 2)
      wake_.notify_one();
    else
      wake_.notify_all();
    job.drain();

    lock.lock();
    Job** link = &jobs_;
    while (*link != &job) link = &(*link)->behind;
    *link = job.behind;
    job.left.wait(lock, [&] { return job.active == 0; });
    lock.unlock();
    if (job.failure) std::rethrow_exception(job.failure);
  }

  ~Pool() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

 private:
  Job* jobInNeed() {
    for (Job* job = jobs_; job; job = job->behind)
      if (job->wanted > 0 && job->next.load(std::memory_order_relaxed) < job->count) return job;
    return nullptr;
  }

  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      Job* job = nullptr;
      wake_.wait(lock, [&] { return stopping_ || (job = jobInNeed()) != nullptr; });
      if (stopping_) return;
      --job->wanted;
      ++job->active;
      lock.unlock();
      job->drain();
      lock.lock();
      if (--job->active == 0) job->left.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<std::thread> workers_;
  Job* jobs_ = nullptr;
  bool stopping_ = false;
};

}  // namespace

void parallelFor(int threads, int count, FunctionRef<void(int)> task) {
  threads = std::min(threads, count);
  if (threads <= 1) {
    for (int i = 0; i < count; ++i) task(i);
    return;
  }
  Job job{task, count};
  Pool::instance().run(job, threads);
}

void TaskProgress::reach(int value) {
  const std::atomic_ref shared(reached);
  shared.store(value, std::memory_order_release);
  shared.notify_all();
}

void TaskProgress::await(int value) {
  const std::atomic_ref shared(reached);
  for (int seen; (seen = shared.load(std::memory_order_acquire)) < value;) shared.wait(seen);
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
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(1, CPU_COUNT(&allowed));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace pomona
