#include "core/output_file.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

namespace cuticle {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_try = "check the folder and the free space";

std::string words_of(int code) { return std::error_code(code, std::generic_category()).message(); }

Error cannot_write(const std::string& path, const std::string& reason) {
  return bad_input(fmt::format("{}: cannot write ({})", path, reason), k_try);
}

/// Temporary files and folders that are there now.
struct Register {
  std::mutex mutex;
  std::set<std::string> paths;
};
Register& present() {
  static Register* const all = new Register;  // also there while the program ends
  return *all;
}
void note(const std::string& path) {
  const std::lock_guard lock(present().mutex);
  present().paths.insert(path);
}
void forget(const std::string& path) {
  const std::lock_guard lock(present().mutex);
  present().paths.erase(path);
}

std::string random_name(const std::string& folder, const std::string& ending) {
  std::array<unsigned char, 12> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != ssize_t(bytes.size())) return {};
  return (fs::path(folder) / fmt::format(".cuticle-{:02x}{}", fmt::join(bytes, ""), ending)).string();
}

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// What `path` names once its links are followed.
struct Target {
  enum class Kind { absent, file, stream } kind = Kind::absent;
  std::string path;
  mode_t mode = 0666;
  uid_t owner = 0;
  gid_t group = 0;
};

/// Follows links that lead to no file yet, too. An open file of a process (/proc/self/fd/1) is a stream.
Result<Target> follow_links(const std::string& path) {
  Target target{.path = path};
  for (int links = 0; links < 40; ++links) {
    std::error_code none;
    const fs::path next = fs::read_symlink(target.path, none);
    if (none) return target;
    if (target.path.starts_with("/proc/")) return Target{Target::Kind::stream, path};
    target.path = (fs::path(folder_of(target.path)) / next).string();
  }
  return cannot_write(path, "too many links");
}

Result<Target> find_target(const std::string& path) {
  if (path == "-") return Target{Target::Kind::stream, path};
  CUTICLE_ASSIGN(Target target, follow_links(path));
  struct stat status {};
  if (target.kind == Target::Kind::stream) return target;
  if (::stat(target.path.c_str(), &status) != 0) {
    if (errno != ENOENT) return cannot_write(path, words_of(errno));
    if (!fs::is_directory(folder_of(target.path)))
      return bad_input(fmt::format("{}: cannot write (no folder {})", path, folder_of(target.path)),
                       "make the folder first");
    return target;
  }
  if (S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode)) return Target{Target::Kind::stream, target.path};
  if (S_ISDIR(status.st_mode)) return cannot_write(path, "it is a folder, not a file");
  if (!S_ISREG(status.st_mode)) return cannot_write(path, "it is neither a file, a device of characters nor a pipe");
  if (::access(target.path.c_str(), W_OK) != 0) return cannot_write(path, words_of(errno));
  return Target{Target::Kind::file, target.path, status.st_mode & 0777, status.st_uid, status.st_gid};
}

Result<void> copy_all(int from, int to, const std::string& path) {
  std::array<char, 1 << 16> block;
  for (;;) {
    const ssize_t got = ::read(from, block.data(), block.size());
    if (got == 0) return {};
    if (got < 0 && errno != EINTR) return cannot_write(path, words_of(errno));
    for (ssize_t done = 0; done < got;) {
      const ssize_t put = ::write(to, block.data() + done, std::size_t(got - done));
      if (put < 0 && errno != EINTR) return cannot_write(path, words_of(errno));
      if (put > 0) done += put;
    }
  }
}

/// A descriptor that is closed at the end; standard output is not.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ > STDERR_FILENO) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }

 private:
  int number_;
};

Result<void> copy_to_stream(const std::string& finished, const std::string& stream) {
  if (stream == "-" && std::fflush(stdout) != 0) return cannot_write("standard output", words_of(errno));
  const Descriptor from(::open(finished.c_str(), O_RDONLY | O_CLOEXEC));
  if (!from.is_open()) return cannot_write(stream, words_of(errno));
  const Descriptor to(stream == "-" ? STDOUT_FILENO : ::open(stream.c_str(), O_WRONLY | O_CLOEXEC));
  if (!to.is_open()) return cannot_write(stream, words_of(errno));
  return copy_all(from.number(), to.number(), stream == "-" ? "standard output" : stream);
}

/// Gives the finished file the rights and, where that is allowed, the owner of what it replaces.
Result<void> replace(const std::string& finished, const Target& target, const std::string& path) {
  if (target.kind == Target::Kind::file) {
    const bool is_kept = ::chown(finished.c_str(), target.owner, target.group) == 0;
    const mode_t mode = is_kept || target.owner == ::geteuid() ? target.mode : target.mode & 0700;
    if (::chmod(finished.c_str(), mode) != 0) return cannot_write(path, words_of(errno));
  }
  if (std::rename(finished.c_str(), target.path.c_str()) == 0) return {};
  return cannot_write(path, words_of(errno));
}

}  // namespace

Temporary::Temporary(std::string path) : path_(std::move(path)) { note(path_); }

Temporary::Temporary(Temporary&& other) noexcept : path_(std::move(other.path_)) { other.path_.clear(); }

Temporary::~Temporary() {
  if (path_.empty()) return;
  forget(path_);
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void Temporary::release() {
  forget(path_);
  path_.clear();
}

Result<Temporary> Temporary::file(const std::string& folder, const std::string& ending, unsigned mode) {
  const std::string path = random_name(folder, ending);
  if (path.empty()) return internal_error("the system gives no random numbers");
  const Descriptor made(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (!made.is_open()) return cannot_write(folder, words_of(errno));
  return Temporary(path);
}

Result<Temporary> Temporary::folder(const std::string& parent) {
  const std::string path = random_name(parent, "");
  if (path.empty()) return internal_error("the system gives no random numbers");
  if (::mkdir(path.c_str(), 0700) != 0) return cannot_write(parent, words_of(errno));
  return Temporary(path);
}

Result<std::string> temporary_folder() {
  const char* chosen = std::getenv("TMPDIR");
  const std::string folder = chosen && *chosen ? chosen : "/tmp";
  std::error_code failed;
  if (fs::is_directory(folder, failed)) return folder;
  return bad_input(fmt::format("{}: no folder for temporary files (TMPDIR)", folder), "let TMPDIR name a folder");
}

void remove_temporaries() {
  const std::lock_guard lock(present().mutex);
  std::error_code ignored;
  for (const std::string& path : present().paths) fs::remove_all(path, ignored);
}

Result<void> write_through_temporary(const std::string& path,
                                     const std::function<Result<void>(const std::string&)>& write) {
  CUTICLE_ASSIGN(const Target target, find_target(path));
  const bool is_stream = target.kind == Target::Kind::stream;
  std::string folder = folder_of(target.path);
  if (is_stream) {
    CUTICLE_ASSIGN(folder, temporary_folder());
  }
  const unsigned mode = target.kind == Target::Kind::absent ? 0666 : 0600;
  Result<Temporary> temporary = Temporary::file(folder, fs::path(target.path).extension().string(), mode);
  if (!temporary) return temporary.error();
  CUTICLE_TRY(write(temporary->path()));
  if (is_stream) return copy_to_stream(temporary->path(), target.path);
  CUTICLE_TRY(replace(temporary->path(), target, path));
  temporary->release();
  return {};
}

Result<void> move_into_place(const std::string& finished, const std::string& path) {
  CUTICLE_ASSIGN(const Target target, find_target(path));
  struct stat file {
  }, folder{};
  const bool is_near = ::stat(finished.c_str(), &file) == 0 && ::stat(folder_of(target.path).c_str(), &folder) == 0 &&
                       file.st_dev == folder.st_dev;
  if (target.kind != Target::Kind::stream && is_near) return replace(finished, target, path);
  return write_through_temporary(path, [&](const std::string& name) -> Result<void> {
    const Descriptor from(::open(finished.c_str(), O_RDONLY | O_CLOEXEC));
    const Descriptor to(::open(name.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
    if (!from.is_open() || !to.is_open()) return cannot_write(path, words_of(errno));
    return copy_all(from.number(), to.number(), path);
  });
}

}  // namespace cuticle
