#pragma once
// Progress of long work: bars on a terminal, JSON lines on request, silent otherwise. Thread-safe.
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace cuticle {

enum class ProgressStyle { automatic, bar, json, silent };

/// Receives progress; the library calls it, the program decides what is shown.
class Progress {
 public:
  virtual ~Progress() = default;
  /// `done` of `total` steps of the task; total 0 means unknown.
  virtual void update(std::string_view task, std::size_t done, std::size_t total) = 0;
  virtual void message(std::string_view text) = 0;
};

/// A reporter that writes to stderr in the given style (automatic: a bar if stderr is a terminal, else silent;
/// messages are always written except in `silent`).
std::unique_ptr<Progress> make_progress(ProgressStyle style);
/// A reporter that drops everything.
Progress& silent_progress();

}  // namespace cuticle
