#include "cli/shared_files.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cuticle::cli {

namespace fs = std::filesystem;

namespace {

fs::path program_folder() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path(".") : self.parent_path();
}

std::string python_program() {
  if (const char* chosen = std::getenv("CUTICLE_PYTHON_EXE")) return chosen;
  const fs::path local = fs::path(CUTICLE_SOURCE_DIR) / ".venv/bin/python";
  return fs::exists(local) ? local.string() : "python3";
}

/// Exit code of a program run with its arguments, without a shell; 127 when it cannot be started.
int run_program(const std::vector<std::string>& arguments) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execvp(pointers[0], pointers.data());
    _exit(127);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child) return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 127;
}

}  // namespace

std::string share_file(const std::string& name) {
  std::vector<fs::path> folders;
  if (const char* share = std::getenv("CUTICLE_SHARE")) folders.emplace_back(share);
  folders.push_back(program_folder() / "../share/cuticle");
  folders.emplace_back(CUTICLE_SOURCE_DIR);
  for (const fs::path& folder : folders)
    if (fs::exists(folder / name)) return (folder / name).lexically_normal().string();
  return (folders.front() / name).string();
}

int run_python(const std::string& module, const std::vector<std::string>& arguments) {
  setenv("PYTHONPATH", share_file("python").c_str(), 1);
  std::vector<std::string> all = {python_program(), "-m", module};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run_program(all);
}

void print_rows(const std::string& csv, const std::string& file) {
  constexpr int shown = 20;
  std::size_t end = 0;
  for (int line = 0; line <= shown && end < csv.size(); ++line) end = std::min(csv.find('\n', end), csv.size() - 1) + 1;
  if (::isatty(STDOUT_FILENO) == 0) end = csv.size();
  fmt::print("{}", csv.substr(0, end));
  if (const auto more = std::count(csv.begin() + std::ptrdiff_t(end), csv.end(), '\n'); more > 0)
    fmt::print("... {} more rows in {}\n", more, file);
}

int make_page(const std::string& mode, const std::string& folder, Progress& progress) {
  const int code = run_python("cuticle_report", mode.empty() ? std::vector{folder} : std::vector{mode, folder});
  if (code == 0)
    progress.message(fmt::format("page: {}/index.html", folder));
  else
    progress.message(fmt::format("no page: '{} -m cuticle_report' ended with {}; the data in {} are complete", python_program(), code, folder));
  return 0;
}

}  // namespace cuticle::cli
