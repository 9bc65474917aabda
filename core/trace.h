#pragma once
// Spans of CPU and GPU work, written as Chrome trace JSON (opens in Perfetto and chrome://tracing).
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "core/result.h"

namespace cuticle {

/// A finished span. Track "cpu" or "gpu"; times in microseconds since the trace began.
struct Span {
  std::string name, track;
  double begin_us = 0, duration_us = 0;
};

/// Collects spans; thread-safe. A null Trace* everywhere means "do not trace".
class Trace {
 public:
  Trace();
  double now_us() const;
  void add(Span span);
  std::vector<Span> spans() const;
  /// Writes {"traceEvents": [...]}; temporary name, then rename.
  Result<void> write(const std::string& path) const;

 private:
  std::chrono::steady_clock::time_point start_;
  mutable std::mutex mutex_;
  std::vector<Span> spans_;
};

/// Adds a CPU span from construction to destruction.
class ScopedSpan {
 public:
  ScopedSpan(Trace* trace, std::string name);
  ~ScopedSpan();
  ScopedSpan(const ScopedSpan&) = delete;
  ScopedSpan& operator=(const ScopedSpan&) = delete;

 private:
  Trace* trace_;
  std::string name_;
  double begin_us_ = 0;
};

}  // namespace cuticle
