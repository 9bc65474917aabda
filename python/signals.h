#pragma once
// Ctrl-C while the interpreter waits for our functions.
#include <stdexcept>

#include <nanobind/nanobind.h>
#include <tbb/task_group.h>

#include "core/progress.h"

namespace cuticle::python {

/// Raises KeyboardInterrupt, or what the handler of another signal raised. Takes the interpreter's lock.
inline void raise_signals() {
  const nanobind::gil_scoped_acquire held;
  if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
}

/// In work that `interruptible` runs: ends it where a signal has come, by an exception that the signal's own replaces.
inline void stop_if_cancelled() {
  if (tbb::is_current_task_group_canceling()) throw std::runtime_error("interrupted");
}

/// Between two steps of long work, in the thread that called it or one that `interruptible` started.
class SignalProgress final : public Progress {
 public:
  void update(std::string_view, std::size_t, std::size_t) override {
    stop_if_cancelled();
    raise_signals();
  }
  void message(std::string_view) override {}
};

/// Calls Python's `progress(task, done, total)`, where there is one, and lets signals end the work.
class CalledProgress final : public Progress {
 public:
  explicit CalledProgress(nanobind::object call) : call_(std::move(call)) {}
  void update(std::string_view task, std::size_t done, std::size_t total) override {
    stop_if_cancelled();
    const nanobind::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
    if (!call_.is_none()) call_(nanobind::str(task.data(), task.size()), done, total);
  }
  void message(std::string_view) override {}

 private:
  nanobind::object call_;
};

}  // namespace cuticle::python
