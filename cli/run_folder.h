#pragma once
// The folder that a run writes: one run at a time, and a list of which files are whose.
#include <functional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"

namespace cuticle::cli {

/// Makes a folder and keeps other runs out of it until the object goes, or the process does.
class RunFolder {
 public:
  /// Error: bad_input where another run writes there.
  static Result<RunFolder> open(const std::string& folder);
  RunFolder(RunFolder&& other) noexcept;
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  RunFolder& operator=(RunFolder&&) = delete;
  ~RunFolder();

  /// A file of this run, by its name in the folder.
  void add(const std::string& name) { files_.push_back(name); }
  /// Writes files.json: the command, whether it came to its end, and the files of this run. Says which files of an
  /// earlier run are left.
  Result<void> finish(const std::string& command, bool is_complete, Progress& progress);

 private:
  RunFolder(std::string folder, int lock, bool is_new) : folder_(std::move(folder)), is_new_(is_new), lock_(lock) {}
  std::string folder_;
  bool is_new_ = false;  ///< made by this run: goes again where nothing was written to it
  int lock_ = -1;        ///< the folder itself, open and locked; -1: its file system has no locks
  std::vector<std::string> files_;
};

/// The exit code of work that writes into the folder, which it has for itself; of no name: of the work.
int in_folder(const std::string& folder, const std::function<int()>& work);

}  // namespace cuticle::cli
