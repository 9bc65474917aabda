#pragma once
// NumPy arrays (.npy, NEP 1): numbers with a shape.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"

namespace cuticle::strands::npz {

struct Array {
  std::string name;  ///< without .npy
  std::vector<std::uint64_t> shape = {};
  std::vector<float> values = {};         ///< C order
  std::vector<std::uint32_t> whole = {};  ///< in place of values, where the array holds whole numbers
  std::string problem = {};               ///< why it cannot be read; then it has no numbers
  std::uint64_t count() const;
  std::uint64_t extent(std::size_t axis) const { return axis < shape.size() ? shape[axis] : 0; }
};

/// Little-endian f2, f4, f8, i1 .. i8, u1 .. u8, bool; C order. Error: bad_input naming the array: what is no .npy,
/// another type (object arrays are Python programs and are never run), Fortran order, a shape that its bytes do not
/// fill, whole numbers outside 0 .. 0xffffffff.
Result<Array> parse_npy(std::span<const std::byte> bytes, const std::string& name, const std::string& where);

std::vector<std::byte> format_npy(std::span<const float> values, std::span<const std::uint64_t> shape);
std::vector<std::byte> format_npy(std::span<const std::uint32_t> values);

}  // namespace cuticle::strands::npz
