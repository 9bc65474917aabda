#pragma once
// Where results go. A regular file is replaced whole and keeps its mode and owner, a link is followed, a device, a pipe
// and "-" (standard output) are written to; anything else is refused.
#include <functional>
#include <string>

#include "core/result.h"

namespace cuticle {

/// A file or folder under a name that nobody can guess, open to this user alone. It goes with the object, and when a
/// signal ends the program.
class Temporary {
 public:
  /// A new empty file in a folder, such as ".cuticle-2f41..09.png". `mode`: its rights, less the umask.
  static Result<Temporary> file(const std::string& folder, const std::string& ending, unsigned mode = 0600);
  static Result<Temporary> folder(const std::string& parent);
  Temporary(Temporary&& other) noexcept;
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  Temporary& operator=(Temporary&&) = delete;
  ~Temporary();

  const std::string& path() const { return path_; }
  /// It stays, or has been renamed.
  void release();

 private:
  explicit Temporary(std::string path);
  std::string path_;
};

/// What TMPDIR names, else /tmp. Error: bad_input where that is no folder.
Result<std::string> temporary_folder();

/// Removes every temporary file and folder of this process: for whoever ends it from a signal.
void remove_temporaries();

/// Calls `write(name)`, then moves what it wrote to `path`; leaves `path` as it was when `write` fails. The name has the
/// extension of `path`. Error: bad_input naming the path and the reason.
Result<void> write_through_temporary(const std::string& path, const std::function<Result<void>(const std::string&)>& write);

/// Moves a finished file to `path`, by the same rules. Error: as above; the finished file stays.
Result<void> move_into_place(const std::string& finished, const std::string& path);

}  // namespace cuticle
