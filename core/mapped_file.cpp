#include "core/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file.h"

namespace cuticle {

void FileBytes::Unmap::operator()(const std::byte* bytes) const { ::munmap(const_cast<std::byte*>(bytes), size); }

Result<FileBytes> map_file(const std::string& path) {
  FileBytes bytes;
  struct stat status {};
  // A pipe is opened once, by read_file: whoever writes to it would notice that it was closed in between.
  const bool is_regular = ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
  const int file = is_regular ? ::open(path.c_str(), O_RDONLY | O_CLOEXEC) : -1;
  if (file >= 0 && ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0) {
    const std::size_t size = std::size_t(status.st_size);
    void* mapped = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file, 0);
    if (mapped != MAP_FAILED) bytes.mapped_ = {static_cast<const std::byte*>(mapped), FileBytes::Unmap{size}};
  }
  if (file >= 0) ::close(file);
  if (bytes.mapped_) return bytes;
  CUTICLE_ASSIGN(bytes.copied_, read_file(path));
  return bytes;
}

}  // namespace cuticle
