#pragma once
// One file per subcommand in cli/commands/NAME.cpp, each defining `void cuticle::cli::add_NAME(CLI::App&, Context&)`.
// CMake finds the files and writes the table. A command parses, calls the libraries, prints; nothing else.
#include <functional>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "core/progress.h"
#include "core/result.h"

namespace cuticle::cli {

/// Options that every command has, and the action that was chosen.
struct Context {
  std::unique_ptr<Progress> progress;
  bool json = false;            ///< --json
  std::string device;           ///< --device
  int threads = 0;              ///< --threads, 0 = all
  std::string trace_file;       ///< --trace FILE: Chrome JSON of the work
  std::function<int()> action;  ///< set by the subcommand's callback; returns the exit code
};

/// Exit codes, as docs/cli.md lists them.
enum Exit { ok = 0, check_failed = 1, usage = 2, bad_input_code = 3, no_device = 4, internal = 5, interrupted = 130 };

/// Prints the error and its hint to stderr; gives the exit code.
int report(const Error& error);

/// "a,b,c" -> parts. "from:to:count" -> count numbers, both ends included. "first:last" -> frames, both included.
std::vector<std::string> split_list(const std::string& text);
Result<std::vector<double>> parse_numbers(const std::string& name, const std::string& text);
Result<std::pair<int, int>> parse_frames(const std::string& text);

}  // namespace cuticle::cli
