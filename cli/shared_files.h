#pragma once
// Files that travel with the program (scenes) and the Python package that makes pages.
#include <string>
#include <vector>

#include "core/progress.h"

namespace cuticle::cli {

/// Full path of a file that travels with the program: in CUTICLE_SHARE, beside the program (../share/cuticle), or in the source tree.
std::string share_file(const std::string& name);

/// Runs a module of the package beside the program with Python's isolated mode, in the root of the file system: paths
/// among the arguments must be absolute. Its exit code; 127 where Python cannot be started.
int run_python(const std::string& module, const std::vector<std::string>& arguments);

/// Runs a Python file in isolated mode, in the root of the file system. Exit codes: as run_python.
int run_script(const std::string& file, const std::vector<std::string>& arguments);

/// Runs this program with other arguments, its stdout dropped, in the root of the file system: paths must be absolute.
/// `needs_display`: under xvfb-run where there is no display. Its exit code; 127 where it cannot be started.
int run_self(const std::vector<std::string>& arguments, bool needs_display = false);

/// Writes rows of CSV to stdout: all of them to a file or pipe, the first twenty to a terminal, with where the rest is.
void print_rows(const std::string& csv, const std::string& file);

/// Runs `python -m cuticle_report [mode] folder`, which makes index.html and the plots from the data there. Where it fails, or
/// Python or the package is missing, says so, leaves the data, and gives the exit code 1.
int make_page(const std::string& mode, const std::string& folder, Progress& progress);

}  // namespace cuticle::cli
