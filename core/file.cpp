#include "core/file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/core.h>

#include "core/memory_limit.h"

namespace cuticle {
namespace {

namespace fs = std::filesystem;

/// An open file, closed at the end.
class OpenFile {
 public:
  OpenFile(const std::string& path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC)) {}
  ~OpenFile() {
    if (is_open()) ::close(number_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  bool is_open() const { return number_ >= 0; }
  int number() const { return number_; }
  /// False with errno where the system could not keep what was written.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

Result<void> write_bytes(const std::string& path, std::span<const std::byte> bytes) {
  const auto failed = [&] {
    return bad_input(fmt::format("{}: cannot write ({})", path, std::strerror(errno)),
                     "check the folder and the free space");
  };
  OpenFile file(path, O_WRONLY | O_TRUNC);
  if (!file.is_open()) return failed();
  while (!bytes.empty()) {
    const ssize_t put = ::write(file.number(), bytes.data(), bytes.size());
    if (put < 0 && errno != EINTR) return failed();
    if (put > 0) bytes = bytes.subspan(std::size_t(put));
  }
  return file.close() ? Result<void>() : Result<void>(failed());
}

/// Up to the end, whatever length the system states: of a pipe and of files in /proc it is 0.
template <class Container>
Result<Container> read_to_end(int file, std::size_t expected, const std::string& path) {
  constexpr std::size_t least = 1 << 16;
  Container bytes(expected + 1, {});
  for (std::size_t size = 0;;) {
    const ssize_t got = ::read(file, bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return bad_input(fmt::format("{}: cannot read ({})", path, std::strerror(errno)));
    size += std::size_t(got);
    if (got == 0) bytes.resize(size);
    if (got == 0) return bytes;
    if (size < bytes.size()) continue;
    CUTICLE_TRY(require_memory(path, {2 * size}));
    bytes.resize(std::max(2 * size, least));
  }
}

template <class Container>
Result<Container> read_whole(const std::string& path) {
  const OpenFile file(path, O_RDONLY);
  if (!file.is_open())
    return bad_input(fmt::format("{}: cannot open ({})", path, std::strerror(errno)), "check the name");
  struct stat status {};
  if (::fstat(file.number(), &status) != 0)
    return bad_input(fmt::format("{}: cannot read ({})", path, std::strerror(errno)));
  if (S_ISDIR(status.st_mode)) return bad_input(fmt::format("{}: is a folder, not a file", path));
  const std::uint64_t expected = S_ISREG(status.st_mode) ? std::uint64_t(status.st_size) : 0;
  CUTICLE_TRY(require_memory(path, {expected}));
  return read_to_end<Container>(file.number(), expected, path);
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::string& path) { return read_whole<std::vector<std::byte>>(path); }

Result<std::string> read_text_file(const std::string& path) { return read_whole<std::string>(path); }

Result<void> write_file(const std::string& path, std::span<const std::byte> bytes) {
  return write_through_temporary(path, [&](const std::string& name) { return write_bytes(name, bytes); });
}

Result<void> write_text_file(const std::string& path, std::string_view text) {
  return write_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

Result<void> make_folder(const std::string& path) {
  std::error_code failed;
  fs::create_directories(path, failed);
  if (failed || !fs::is_directory(path, failed))
    return bad_input(
        fmt::format("{}: cannot make the folder ({})", path, failed ? failed.message() : "a file has this name"));
  return {};
}

}  // namespace cuticle
