#include "cli/boundary.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <fmt/core.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include "cli/command.h"
#include "core/interrupt.h"
#include "core/json/json.h"
#include "core/memory_limit.h"
#include "core/output_file.h"

namespace cuticle::cli {
namespace {

constexpr int k_signals[] = {SIGINT, SIGTERM, SIGHUP};

/// Without it, the first file that is opened would get the number of a closed stream and be written over by it. What is
/// written to a closed standard output fails.
void open_standard_streams() {
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) (void)::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

/// Of the exception that is being handled.
Error current_error() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return {ErrorKind::out_of_memory, "there is not enough memory", "ask for less, or read a smaller file"};
  } catch (const std::length_error& error) {
    return {ErrorKind::out_of_memory, fmt::format("more was asked for than any memory holds ({})", error.what()),
            "ask for less, or read a smaller file"};
  } catch (const std::filesystem::filesystem_error& error) {
    return bad_input(fmt::format("{}: {}", error.path1().string(), error.code().message()));
  } catch (const std::system_error& error) {
    return bad_input(fmt::format("cannot read or write ({})", error.code().message()),
                     "check standard output and the disk");
  } catch (const Json::Mismatch& error) {
    return bad_input(error.what());
  } catch (const std::exception& error) {
    return internal_error(error.what());
  } catch (...) {
    return internal_error("an exception of no known kind");
  }
}

int report_current() { return report(current_error()); }

/// For exceptions that no one can catch any more: of a thread of its own, or out of what promised none.
[[noreturn]] void end_uncaught() {
  const int code = std::current_exception() ? report_current() : report(internal_error("the work was given up"));
  remove_temporaries();
  std::_Exit(code);
}

[[noreturn]] void end_at_once(int code) {
  remove_temporaries();
  std::_Exit(code);
}

void on_signal(int signal) {
  const bool is_again = !ask_to_stop();
  const char* const words = is_again ? "cuticle: interrupted; what was half written is removed\n"
                                     : "cuticle: interrupted; the step in work is finished and results are kept; "
                                       "a second interrupt ends at once\n";
  std::fputs(words, stderr);
  if (is_again) end_at_once(128 + signal);
}

/// A file that another program cuts short while it is mapped.
void on_bus_error(int) {
  constexpr char words[] = "cuticle: error: a file became shorter while it was read\n";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, words, sizeof(words) - 1);
  ::_exit(Exit::bad_input_code);
}

/// Those that the caller does not ignore, as `nohup` and shells do for work in the background.
sigset_t watched_signals() {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int signal : k_signals) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) ::sigaddset(&set, signal);
  }
  return set;
}

/// A thread waits for signals, so that what they do may be what any code does.
void watch_signals() {
  std::signal(SIGBUS, on_bus_error);
  const sigset_t set = watched_signals();
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
  std::thread([set] {
    for (int signal = 0; ::sigwait(&set, &signal) == 0;) on_signal(signal);
  }).detach();
}

/// What was printed may still wait in memory; only now is it known whether it could be written.
int flushed(int code) {
  errno = 0;
  if ((std::fflush(stdout) == 0 && std::ferror(stdout) == 0) || code != Exit::ok) return code;
  const std::string reason = errno != 0 ? std::error_code(errno, std::generic_category()).message() : "an error before";
  return report(bad_input(fmt::format("standard output: cannot write ({})", reason), "check where it leads to"));
}

}  // namespace

void restore_signals() {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int signal : k_signals) ::sigaddset(&set, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

Result<void> limit_memory(std::uint64_t bytes) {
  set_memory_limit(bytes);
  const rlimit limit{bytes, bytes};
  if (::setrlimit(RLIMIT_DATA, &limit) == 0) return {};
  return internal_error(fmt::format("--max-memory: {}", std::error_code(errno, std::generic_category()).message()));
}

int guarded(const std::function<int()>& work) {
  open_standard_streams();
  std::set_terminate(end_uncaught);
  int code = Exit::internal;
  try {
    watch_signals();
    code = work();
  } catch (...) {
    code = report_current();
  }
  return flushed(code);
}

}  // namespace cuticle::cli
