#include "core/progress.h"

#include <chrono>
#include <mutex>

#include <unistd.h>

#include <fmt/core.h>

#include "core/json/json.h"

namespace cuticle {
namespace {

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
    fmt::print(stderr, "{}\n", text);
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
    const std::string text = line.dump();
    const std::lock_guard lock(mutex_);
    fmt::print(stderr, "{}\n", text);
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
    if (finished) fmt::print(stderr, "\n");
  }
  void message(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    clear();
    fmt::print(stderr, "{}\n", text);
  }

 private:
  static void draw(std::string_view task, std::size_t done, std::size_t total) {
    if (total == 0) return fmt::print(stderr, "\r\033[K{} {}", task, done);
    constexpr std::size_t width = 32;
    const std::size_t filled = done >= total ? width : std::size_t(double(done) / double(total) * width);
    fmt::print(stderr, "\r\033[K{:<28} [{:=<{}}{:<{}}] {}/{}", task, "", filled, "", width - filled, done, total);
    std::fflush(stderr);
  }
  void clear() {
    if (shown_) fmt::print(stderr, "\r\033[K");
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
