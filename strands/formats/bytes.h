#pragma once
// Little-endian numbers in and out of bytes, bounds-checked by the caller through `has`.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "strands/formats/format.h"
#include "strands/large.h"

namespace cuticle::strands {

/// Reads numbers at byte offsets. `where` names the file in messages.
class ByteView {
 public:
  ByteView(std::span<const std::byte> bytes, const std::string& where) : bytes_(bytes), where_(where) {}
  std::uint64_t size() const { return bytes_.size(); }
  const std::byte* data() const { return bytes_.data(); }
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

/// Error unless `count` floats from `offset` lie in the file.
Result<void> require_floats(const ByteView& bytes, const std::string& field, std::uint64_t offset, std::uint64_t count);
/// Error naming field, index and offset of the first value that is not finite, unless damage is kept. `values` begin at
/// number `first` of the field, which begins at `offset`.
Result<void> require_finite(const ByteView& bytes, const std::string& field, std::uint64_t offset, std::uint64_t first,
                            std::span<const float> values, Damage damage);

/// Reads `count` items made of floats (float, glm::vec2, glm::vec3). In blocks: each is checked while it is in the
/// cache.
template <class T>
Result<std::vector<T>> read_array(const ByteView& bytes, const std::string& field, std::uint64_t offset,
                                  std::uint64_t count, Damage damage = Damage::refuse) {
  constexpr std::uint64_t components = sizeof(T) / sizeof(float);
  CUTICLE_TRY(require_floats(bytes, field, offset, count * components));
  std::vector<T> items;
  reserve_large(items, count);
  T block[1024];
  for (std::uint64_t first = 0; first < count; first += std::size(block)) {
    const std::uint64_t size = std::min<std::uint64_t>(std::size(block), count - first);
    std::memcpy(static_cast<void*>(block), bytes.data() + offset + first * sizeof(T), size * sizeof(T));
    CUTICLE_TRY(require_finite(bytes, field, offset, first * components,
                               {reinterpret_cast<const float*>(block), size * components}, damage));
    items.insert(items.end(), block, block + size);
  }
  return items;
}

static_assert(std::endian::native == std::endian::little, "the strand formats are little-endian");

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
  const std::size_t begin = bytes.size();
  bytes.resize(begin + sizeof(T));
  std::memcpy(bytes.data() + begin, &value, sizeof(T));
}

template <class T>
void append_all(std::vector<std::byte>& bytes, std::span<const T> values) {
  const auto raw = std::as_bytes(values);
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

inline std::vector<std::byte> to_bytes(std::string_view text) {
  const auto raw = std::as_bytes(std::span(text.data(), text.size()));
  return {raw.begin(), raw.end()};
}
inline std::string_view to_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace cuticle::strands
