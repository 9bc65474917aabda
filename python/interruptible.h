#pragma once
// Long calls that Ctrl-C ends.
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include <tbb/task_group.h>

#include "python/signals.h"

namespace cuticle::python {

/// Called about ten times a second while work goes on, in the thread that waits for it; null: nothing is. Whoever sets
/// it keeps it alive (_progress.py).
inline thread_local PyObject* ticker = nullptr;

inline void tick() {
  if (!ticker) return;
  const nanobind::gil_scoped_acquire held;
  const nanobind::handle call(ticker);
  call();
}

/// What `work` returns, done in a thread of its own without the interpreter's lock, while this thread looks for signals
/// ten times a second. A signal cancels the work's parallel loops; what it returns is then dropped, and the signal's
/// exception raised.
template <class Work>
auto interruptible(const Work& work) {
  using Value = decltype(work());
  std::optional<Value> value;
  std::exception_ptr failed, signal;
  std::mutex mutex;
  std::condition_variable ended;
  bool done = false;
  tbb::task_group_context context;
  const auto run = [&] {
    try {
      tbb::task_group group(context);
      group.run_and_wait([&] { value.emplace(work()); });
    } catch (...) {
      failed = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    done = true;
    ended.notify_one();
  };
  const nanobind::gil_scoped_release released;
  std::thread worker(run);
  for (std::unique_lock lock(mutex); !ended.wait_for(lock, std::chrono::milliseconds(100), [&] { return done; });) {
    lock.unlock();
    try {
      if (!signal) raise_signals(), tick();
    } catch (...) {
      signal = std::current_exception();
      context.cancel_group_execution();
    }
    lock.lock();
  }
  worker.join();
  if (signal) std::rethrow_exception(signal);
  if (failed) std::rethrow_exception(failed);
  return std::move(*value);
}

}  // namespace cuticle::python
