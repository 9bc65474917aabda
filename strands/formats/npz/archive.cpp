#include <algorithm>
#include <memory>
#include <span>

#include <fmt/core.h>
#include <zip.h>

#include "core/memory_limit.h"
#include "strands/formats/npz/detail/archive.h"

namespace cuticle::strands::npz {

namespace {

struct Close {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
template <class T>
using Owned = std::unique_ptr<T, Close>;

class ZipError {
 public:
  ZipError() { zip_error_init(&error_); }
  ~ZipError() { zip_error_fini(&error_); }
  ZipError(const ZipError&) = delete;
  ZipError& operator=(const ZipError&) = delete;
  zip_error_t* get() { return &error_; }
  std::string text() { return zip_error_strerror(&error_); }

 private:
  zip_error_t error_;
};

// Deflate shrinks by 1032 at most: what claims more is no true size, and must not be allocated.
constexpr std::uint64_t k_max_shrinking = 1032, k_least_bytes = 64;
constexpr std::uint64_t k_at_once = std::uint64_t(1) << 28;  // inflating counts in 32 bits

Result<Member> read_member(zip_t* archive, std::uint64_t index, std::uint64_t archive_bytes, const std::string& where) {
  zip_stat_t stat;
  if (zip_stat_index(archive, index, 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE) || !(stat.valid & ZIP_STAT_NAME))
    return bad_input(fmt::format("{}: member {}: {}", where, index, zip_strerror(archive)));
  if (stat.size > k_max_shrinking * archive_bytes + k_least_bytes)
    return bad_input(
        fmt::format("{}: member {} claims {} bytes, more than the file can hold", where, stat.name, stat.size));
  CUTICLE_TRY(require_memory(fmt::format("{}: member {}", where, stat.name), {stat.size}));
  const Owned<zip_file_t> file(zip_fopen_index(archive, index, 0));
  if (!file) return bad_input(fmt::format("{}: member {}: {}", where, stat.name, zip_strerror(archive)));
  Member member{stat.name, std::vector<std::byte>(stat.size)};
  for (std::uint64_t done = 0; done < stat.size;) {
    const zip_int64_t got = zip_fread(file.get(), member.bytes.data() + done, std::min(stat.size - done, k_at_once));
    if (got <= 0) return bad_input(fmt::format("{}: member {}: {}", where, stat.name, zip_file_strerror(file.get())));
    done += std::uint64_t(got);
  }
  return member;
}

/// The bytes of a source that an archive was written to.
Result<std::vector<std::byte>> bytes_of(zip_source_t* source) {
  zip_stat_t stat;
  if (zip_source_stat(source, &stat) != 0 || zip_source_open(source) != 0)
    return internal_error("zip: the archive cannot be read back");
  std::vector<std::byte> bytes(stat.size);
  const zip_int64_t read = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  if (read != zip_int64_t(bytes.size())) return internal_error("zip: the archive cannot be read back");
  return bytes;
}

bool add(zip_t* archive, const Member& member) {
  zip_source_t* source = zip_source_buffer(archive, member.bytes.data(), member.bytes.size(), 0);
  const zip_int64_t index = source ? zip_file_add(archive, member.name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
  if (index < 0) {
    zip_source_free(source);
    return false;
  }
  constexpr zip_uint16_t first_day = (1 << 5) | 1;  // 1980-01-01 in the date of DOS
  return zip_set_file_compression(archive, zip_uint64_t(index), ZIP_CM_STORE, 0) == 0 &&
         zip_file_set_dostime(archive, zip_uint64_t(index), 0, first_day, 0) == 0;
}

}  // namespace

Result<std::vector<Member>> read_archive(std::span<const std::byte> bytes, const std::string& where) {
  ZipError error;
  Owned<zip_source_t> source(zip_source_buffer_create(bytes.data(), bytes.size(), 0, error.get()));
  const Owned<zip_t> archive(source ? zip_open_from_source(source.get(), ZIP_RDONLY, error.get()) : nullptr);
  if (!archive) return bad_input(fmt::format("{}: no zip archive: {}", where, error.text()));
  source.release();  // the archive's own now
  std::vector<Member> members;
  std::uint64_t total = 0;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive.get(), 0); ++i) {
    CUTICLE_ASSIGN(Member member, read_member(archive.get(), zip_uint64_t(i), bytes.size(), where));
    total += member.bytes.size();
    if (total > k_max_shrinking * bytes.size() + k_least_bytes)
      return bad_input(fmt::format("{}: members claim {} bytes, more than the file can hold", where, total));
    CUTICLE_TRY(require_memory(fmt::format("{}: what its members hold", where), {total}));
    members.push_back(std::move(member));
  }
  return members;
}

Result<std::vector<std::byte>> write_archive(const std::vector<Member>& members) {
  ZipError error;
  Owned<zip_source_t> source(zip_source_buffer_create(nullptr, 0, 0, error.get()));
  Owned<zip_t> archive(source ? zip_open_from_source(source.get(), ZIP_TRUNCATE, error.get()) : nullptr);
  if (!archive) return internal_error("zip: " + error.text());
  zip_source_keep(source.get());  // for reading it back once the archive is closed
  for (const Member& member : members)
    if (!add(archive.get(), member)) return internal_error(std::string("zip: ") + zip_strerror(archive.get()));
  if (zip_close(archive.get()) != 0) return internal_error(std::string("zip: ") + zip_strerror(archive.get()));
  archive.release();
  return bytes_of(source.get());
}

}  // namespace cuticle::strands::npz
