#pragma once
// Little-endian numbers in and out of files, bounds checked; an error says file, field, offset, value and what is
// allowed.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/result.h"

namespace cuticle::lut {

class ByteWriter {
 public:
  void u8(std::uint8_t value) { put(value, 1); }
  void u16(std::uint16_t value) { put(value, 2); }
  void u32(std::uint32_t value) { put(value, 4); }
  void u64(std::uint64_t value) { put(value, 8); }
  void text(std::string_view text) {
    for (const char c : text) u8(std::uint8_t(c));
  }
  void pad_to(std::size_t multiple) {
    while (bytes_.size() % multiple != 0) u8(0);
  }
  std::size_t size() const { return bytes_.size(); }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  void put(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes_.push_back(std::byte(value >> (8 * i)));
  }
  std::vector<std::byte> bytes_;
};

/// The number of `count` bytes at an offset that lies inside.
inline std::uint64_t number_at(std::span<const std::byte> bytes, std::size_t offset, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value |= std::uint64_t(bytes[offset + i]) << (8 * i);
  return value;
}

/// Fields of a file at known offsets.
class FieldReader {
 public:
  FieldReader(std::span<const std::byte> bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  Result<std::uint64_t> number(std::string_view field, std::size_t offset, int count) const {
    if (offset + count > bytes_.size())
      return bad_input(fmt::format("{}: {} at offset {}: the file ends at {}", file_, field, offset, bytes_.size()),
                       "write it again with cuticle bake");
    return number_at(bytes_, offset, count);
  }
  /// A number that must have one value.
  Result<void> expect(std::string_view field, std::size_t offset, int count, std::uint64_t wanted,
                      std::string_view meaning) const {
    CUTICLE_ASSIGN(const std::uint64_t found, number(field, offset, count));
    if (found == wanted) return {};
    return refuse(field, offset, found, fmt::format("{} ({})", wanted, meaning));
  }
  /// A number within a range.
  Result<std::uint64_t> within(std::string_view field, std::size_t offset, int count, std::uint64_t lowest,
                               std::uint64_t highest) const {
    CUTICLE_ASSIGN(const std::uint64_t found, number(field, offset, count));
    if (found >= lowest && found <= highest) return found;
    return refuse(field, offset, found, fmt::format("{} .. {}", lowest, highest));
  }
  /// The bytes of a part of the file.
  Result<std::span<const std::byte>> part(std::string_view field, std::uint64_t offset, std::uint64_t count) const {
    if (offset <= bytes_.size() && count <= bytes_.size() - offset) return bytes_.subspan(offset, count);
    return bad_input(fmt::format("{}: {} at offset {}: {} bytes are needed, the file ends at {}", file_, field, offset,
                                 count, bytes_.size()),
                     "write it again with cuticle bake");
  }

 private:
  Error refuse(std::string_view field, std::size_t offset, std::uint64_t found, std::string_view allowed) const {
    return bad_input(fmt::format("{}: {} at offset {} is {}; allowed: {}", file_, field, offset, found, allowed),
                     "write it again with cuticle bake, uncompressed and without mip maps");
  }
  std::span<const std::byte> bytes_;
  std::string file_;
};

}  // namespace cuticle::lut
