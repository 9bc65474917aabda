#pragma once
// Little-endian numbers in and out of bytes, bounds-checked by the caller through `has`.
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <cuticle/core/result.h>

namespace cuticle::strands {

/// Reads numbers at byte offsets. `where` names the file in messages.
class ByteView {
 public:
  ByteView(std::span<const std::byte> bytes, const std::string& where) : bytes_(bytes), where_(where) {}
  std::uint64_t size() const { return bytes_.size(); }
  const std::string& where() const { return where_; }
  bool has(std::uint64_t offset, std::uint64_t count) const { return offset <= size() && count <= size() - offset; }

  template <class T>
  T at(std::uint64_t offset) const {
    CUTICLE_EXPECT(has(offset, sizeof(T)), "read past the end");
    T value;
    std::memcpy(&value, bytes_.data() + offset, sizeof(T));
    return value;
  }

  /// bad_input "FILE: FIELD at offset N: PROBLEM".
  Error error(const std::string& field, std::uint64_t offset, const std::string& problem) const {
    return bad_input(where_ + ": " + field + " at offset " + std::to_string(offset) + ": " + problem,
                     "check that the file was copied whole and is of the kind that its name says");
  }

 private:
  std::span<const std::byte> bytes_;
  const std::string& where_;
};

/// Reads finite floats [offset, offset + 4 count). Error names field, index and offset of the first that is not finite.
Result<std::vector<float>> read_floats(const ByteView& bytes, const std::string& field, std::uint64_t offset,
                                       std::uint64_t count);

static_assert(std::endian::native == std::endian::little, "the strand formats are little-endian");

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
  const std::size_t begin = bytes.size();
  bytes.resize(begin + sizeof(T));
  std::memcpy(bytes.data() + begin, &value, sizeof(T));
}

}  // namespace cuticle::strands
