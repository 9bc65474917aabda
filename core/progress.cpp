#include "core/progress.h"

#include <chrono>
#include <cstdio>
#include <mutex>

#include <unistd.h>

#include <fmt/core.h>

#include "core/json/json.h"
#include "core/text.h"

namespace cuticle {
namespace {

/// A lost message is no reason to end the work: what cannot be written to stderr is dropped.
void print_line(std::string_view text) {
  const std::string line = printable(text) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

class SilentProgress final : public Progress {
 public:
  void update(std::string_view, std::size_t, std::size_t) override {}
  void message(std::string_view) override {}
};

/// Messages only: for logs and pipes.
class MessageProgress final : public Progress {
 public:
  void update(std::string_view, std::size_t, std::size_t) override {}
  void message(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    print_line(text);
  }

 private:
  std::mutex mutex_;
};

class JsonProgress final : public Progress {
 public:
  void update(std::string_view task, std::size_t done, std::size_t total) override {
    print({{"task", std::string(task)}, {"done", done}, {"total", total}});
  }
  void message(std::string_view text) override { print({{"message", std::string(text)}}); }

 private:
  void print(const Json& line) {
    const std::string text = line.dump() + "\n";
    const std::lock_guard lock(mutex_);
    std::fwrite(text.data(), 1, text.size(), stderr);
  }
  std::mutex mutex_;
};

/// One line, rewritten at most twenty times a second and when a task ends.
class BarProgress final : public Progress {
 public:
  ~BarProgress() override { clear(); }

  void update(std::string_view task, std::size_t done, std::size_t total) override {
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    const bool finished = total > 0 && done >= total;
    if (!finished && now - last_ < std::chrono::milliseconds(50)) return;
    last_ = now;
    draw(task, done, total);
    shown_ = !finished;
    if (finished) std::fputc('\n', stderr);
  }
  void message(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    clear();
    print_line(text);
  }

 private:
  static void draw(std::string_view task, std::size_t done, std::size_t total) {
    constexpr std::size_t width = 32;
    const std::size_t filled = total == 0 ? 0 : done >= total ? width : std::size_t(double(done) / double(total) * width);
    const std::string line =
        total == 0 ? fmt::format("\r\033[K{} {}", task, done)
                   : fmt::format("\r\033[K{:<28} [{:=<{}}{:<{}}] {}/{}", task, "", filled, "", width - filled, done, total);
    std::fwrite(line.data(), 1, line.size(), stderr);
    std::fflush(stderr);
  }
  void clear() {
    if (shown_) std::fputs("\r\033[K", stderr);
    shown_ = false;
  }

  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_{};
  bool shown_ = false;
};

}  // namespace

std::unique_ptr<Progress> make_progress(ProgressStyle style) {
  if (style == ProgressStyle::automatic && ::isatty(STDERR_FILENO) != 0) style = ProgressStyle::bar;
  switch (style) {
    case ProgressStyle::bar: return std::make_unique<BarProgress>();
    case ProgressStyle::json: return std::make_unique<JsonProgress>();
    case ProgressStyle::automatic: return std::make_unique<MessageProgress>();
    case ProgressStyle::silent: break;
  }
  return std::make_unique<SilentProgress>();
}

Progress& silent_progress() {
  static SilentProgress silent;
  return silent;
}

}  // namespace cuticle
