#include "core/file.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <fmt/core.h>

namespace cuticle {
namespace {

namespace fs = std::filesystem;

std::string last_reason() { return errno != 0 ? std::strerror(errno) : "unknown reason"; }

/// A name beside `path` that no other process or thread uses, with the same extension.
std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> counter{0};
  const fs::path target(path);
  const std::string name = fmt::format(".{}.{}-{}{}", target.stem().string(), ::getpid(), counter++, target.extension().string());
  return (target.parent_path() / name).string();
}

void remove_quietly(const std::string& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

Result<void> write_bytes(const std::string& path, std::span<const std::byte> bytes) {
  errno = 0;
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  if (stream) stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  if (stream) stream.close();
  if (!stream) return bad_input(fmt::format("{}: cannot write ({})", path, last_reason()), "check the folder and the free space");
  return {};
}

template <class Container>
Result<Container> read_whole(const std::string& path) {
  errno = 0;
  std::error_code failed;
  if (fs::is_directory(path, failed)) return bad_input(fmt::format("{}: is a folder, not a file", path));
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  if (!stream) return bad_input(fmt::format("{}: cannot open ({})", path, last_reason()), "check the name");
  Container bytes(std::size_t(stream.tellg()), {});
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size()));
  if (!stream) return bad_input(fmt::format("{}: cannot read ({})", path, last_reason()));
  return bytes;
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::string& path) { return read_whole<std::vector<std::byte>>(path); }

Result<std::string> read_text_file(const std::string& path) { return read_whole<std::string>(path); }

Result<void> write_through_temporary(const std::string& path, const std::function<Result<void>(const std::string&)>& write) {
  const std::string temporary = temporary_name(path);
  if (Result<void> written = write(temporary); !written) {
    remove_quietly(temporary);
    return written;
  }
  std::error_code failed;
  fs::rename(temporary, path, failed);
  if (!failed) return {};
  remove_quietly(temporary);
  return bad_input(fmt::format("{}: cannot write ({})", path, failed.message()));
}

Result<void> write_file(const std::string& path, std::span<const std::byte> bytes) {
  Result<void> written = write_through_temporary(path, [&](const std::string& name) { return write_bytes(name, bytes); });
  if (written) return written;
  const std::string folder = fs::path(path).parent_path().string();
  if (folder.empty() || fs::is_directory(folder)) return written;
  return bad_input(fmt::format("{}: cannot write (no folder {})", path, folder), "make the folder first");
}

Result<void> write_text_file(const std::string& path, std::string_view text) {
  return write_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

Result<void> make_folder(const std::string& path) {
  std::error_code failed;
  fs::create_directories(path, failed);
  if (failed || !fs::is_directory(path))
    return bad_input(fmt::format("{}: cannot make the folder ({})", path, failed ? failed.message() : "a file has this name"));
  return {};
}

}  // namespace cuticle
