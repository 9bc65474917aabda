#include "cli/shared_files.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/boundary.h"
#include "cli/command.h"

namespace cuticle::cli {

namespace fs = std::filesystem;

namespace {

/// Empty where the system does not tell.
fs::path program_folder() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

std::string python_program() {
  if (const char* chosen = std::getenv("CUTICLE_PYTHON_EXE"))
    return fs::path(chosen).has_parent_path() ? fs::absolute(chosen).string() : chosen;
  const fs::path local = fs::path(CUTICLE_SOURCE_DIR) / ".venv/bin/python";
  return fs::exists(local) ? local.string() : "python3";
}

/// Exit code of a program run with its arguments, without a shell; 127 when it cannot be started. It runs in the root
/// of the file system: libraries read settings from the folder that they are started in (matplotlibrc).
int run_program(const std::vector<std::string>& arguments, bool quiet = false) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    restore_signals();
    if (chdir("/") != 0) _exit(127);
    if (quiet && !std::freopen("/dev/null", "w", stdout)) _exit(127);
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
  if (const fs::path folder = program_folder(); !folder.empty()) folders.push_back(folder / "../share/cuticle");
  folders.emplace_back(CUTICLE_SOURCE_DIR);
  for (const fs::path& folder : folders)
    if (fs::exists(folder / name)) return (folder / name).lexically_normal().string();
  return (folders.front() / name).string();
}

namespace {

/// The package as this program's build made it, with the compiled half, and empty; else what travels with the program.
std::pair<fs::path, bool> package_folder() {
  const fs::path own = (program_folder() / "../python").lexically_normal();
  if (fs::exists(own / "cuticle")) return {own, true};
  return {fs::absolute(share_file("python")), false};
}

}  // namespace

int run_python(const std::string& module, const std::vector<std::string>& arguments) {
  // -I: nothing is imported from the current folder, from PYTHONPATH or from beside the data. The build's own package
  // comes first, so that another build's is not taken; sources that travel with the program come last.
  constexpr const char* start =
      "import runpy, site, sys\n"
      "if sys.prefix == sys.base_prefix: site.addsitedir(site.getusersitepackages())\n"
      "folder, place, module = sys.argv[1:4]\n"
      "del sys.argv[1:4]\n"
      "sys.path.insert(0 if place == 'first' else len(sys.path), folder)\n"
      "runpy.run_module(module, run_name='__main__', alter_sys=True)";
  const auto [folder, is_built] = package_folder();
  std::vector<std::string> all = {
      python_program(), "-I", "-c", start, folder.string(), is_built ? "first" : "last", module};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run_program(all);
}

int run_script(const std::string& file, const std::vector<std::string>& arguments) {
  std::vector<std::string> all = {python_program(), "-I", file};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run_program(all);
}

int run_self(const std::vector<std::string>& arguments, bool needs_display) {
  std::vector<std::string> all;
  if (needs_display && !std::getenv("DISPLAY")) all = {"xvfb-run", "-a"};
  std::error_code error;
  all.push_back(fs::read_symlink("/proc/self/exe", error).string());
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run_program(all, true);
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
  const std::string place = fs::absolute(folder).string();
  const int code = run_python("cuticle_report", mode.empty() ? std::vector{place} : std::vector{mode, place});
  if (code == 0) {
    progress.message(fmt::format("page: {}/index.html", folder));
    return Exit::ok;
  }
  progress.message(fmt::format("no page: '{} -m cuticle_report' ended with {}; the data in {} are complete",
                               python_program(), code, folder));
  return Exit::check_failed;
}

}  // namespace cuticle::cli
