#pragma once
// Large files in, at the speed of the page cache.
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"

namespace cuticle {

/// The bytes of a file, mapped from the page cache where it is a regular file. A file that another program cuts short
/// meanwhile ends this one; files that are replaced, as write_file does, stay whole.
class FileBytes {
 public:
  std::span<const std::byte> span() const {
    return mapped_ ? std::span(mapped_.get(), mapped_.get_deleter().size) : copied_;
  }

 private:
  friend Result<FileBytes> map_file(const std::string& path);
  struct Unmap {
    std::size_t size;
    void operator()(const std::byte* bytes) const;
  };
  std::unique_ptr<const std::byte, Unmap> mapped_;
  std::vector<std::byte> copied_;  ///< of what cannot be mapped: pipes, empty files
};
/// As read_file, for large files.
Result<FileBytes> map_file(const std::string& path);

}  // namespace cuticle
