#pragma once
// A number that stands for the content of what a result was made of: equal inputs have equal keys.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "core/view.h"

namespace cuticle {

/// FNV-1a over 64-bit words (a last word filled up with zeros), after `key`. Two contents that differ share a key with
/// a chance of about 2^-64.
class ContentKey {
 public:
  void add(std::span<const std::byte> bytes) {
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + at, std::min(bytes.size() - at, sizeof(word)));
      mix(word);
    }
    mix(bytes.size());
  }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void add(std::span<const T> values) { add(std::as_bytes(values)); }
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) { add(std::span<const T>(&value, 1)); }
  void add(const glm::dmat4& matrix) { add(std::span<const glm::dmat4>(&matrix, 1)); }
  void add(const Camera& camera) {
    for (const glm::dvec3& vector : {camera.position, camera.target, camera.up})
      add(std::span<const glm::dvec3>(&vector, 1));
    for (double number : {camera.vertical_field_of_view, camera.near_plane, camera.far_plane, camera.pixel_shift.x,
                          camera.pixel_shift.y})
      add(number);
  }
  std::uint64_t value() const { return key_; }

 private:
  void mix(std::uint64_t word) {
    key_ = (key_ ^ word) * 0x100000001b3ull;
    key_ ^= key_ >> 29;
  }
  std::uint64_t key_ = 0xcbf29ce484222325ull;
};

}  // namespace cuticle
