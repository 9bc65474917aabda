#include "viz/window/display.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>
#include <utility>

#include <X11/Xlib.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cuticle::viz {
namespace {

Error no_display(std::string message) {
  return {ErrorKind::no_device, std::move(message),
          "install xvfb for pictures without a display (Debian: apt-get install xvfb libgl1-mesa-dri), or set DISPLAY"};
}

/// A connection to the display; a virtual one starts anew, and refuses for a moment, when its only client leaves.
Result<OpenDisplay> connect(const char* name) {
  Display* const display = XOpenDisplay(name);
  if (!display) return no_display(fmt::format("views need an X display, and DISPLAY={} does not answer", name));
  return OpenDisplay(display, [](void* open) { XCloseDisplay(static_cast<Display*>(open)); });
}

/// In the child: the server writes its number to `out` and ends with us.
[[noreturn]] void become_server(int out) {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);  // the command line blocks signals, and the server would inherit that
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  setsid();
  const int silent = open("/dev/null", O_RDWR);
  dup2(silent, STDIN_FILENO);
  dup2(silent, STDERR_FILENO);
  dup2(out, STDOUT_FILENO);
  execlp("Xvfb", "Xvfb", "-displayfd", "1", "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset", nullptr);
  _exit(127);
}

/// The number that the server writes once it answers; empty where it ends before, or takes longer than 20 seconds.
std::string read_number(int in) {
  std::string text;
  pollfd wait{in, POLLIN, 0};
  while (text.find('\n') == std::string::npos) {
    char part[16];
    if (poll(&wait, 1, 20000) <= 0) return {};
    const ssize_t count = read(in, part, sizeof part);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return {};
    text.append(part, std::size_t(count));
  }
  return text.substr(0, text.find('\n'));
}

/// Xvfb, which is ended with the object.
struct Server {
  explicit Server(pid_t started) : process(started) {}
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  ~Server() {
    connection.reset();
    end_process();
    unsetenv("DISPLAY");
  }
  /// By its own way, so that its lock files go; by force after two seconds.
  void end_process() const {
    kill(process, SIGTERM);
    for (int turn = 0; turn < 100; ++turn) {
      if (waitpid(process, nullptr, WNOHANG) != 0) return;
      usleep(20000);
    }
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
  }
  pid_t process;
  OpenDisplay connection;
};

Result<OpenDisplay> start_server() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return internal_error("no pipe for Xvfb");
  const pid_t child = fork();
  if (child == 0) become_server(ends[1]);
  close(ends[1]);
  const std::string number = child > 0 ? read_number(ends[0]) : std::string();
  close(ends[0]);
  if (child < 0) return internal_error("Xvfb cannot be started");
  auto server = std::make_shared<Server>(child);
  if (number.empty()) return no_display("views need an X display: DISPLAY is not set, and Xvfb does not start");
  setenv("DISPLAY", (":" + number).c_str(), 1);
  CUTICLE_ASSIGN(server->connection, connect((":" + number).c_str()));
  return OpenDisplay(server);
}

}  // namespace

Result<OpenDisplay> open_display(bool for_window) {
  const char* const name = std::getenv("DISPLAY");
  if (name && *name) return connect(name);
  if (!for_window) return start_server();
  return Error{ErrorKind::no_device, "a window needs an X display, and DISPLAY is not set",
               "--screenshot FILE.png draws without a display, or set DISPLAY"};
}

}  // namespace cuticle::viz
