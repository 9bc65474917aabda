#pragma once
// The container PLY: elements with named numbers.
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace cuticle::strands::ply {

/// A number of an element: as C++'s type names it and how the file writes it.
struct Property {
  std::string name;
  char kind = 'f';  ///< f: floating point, i: signed, u: unsigned
  int bytes = 4;
  std::vector<double> values{};  ///< one per row; empty for a list, which is passed over
  bool is_list = false;
};

struct Element {
  std::string name;
  std::size_t rows = 0;
  std::vector<Property> properties{};
  const Property* find(std::string_view property) const;
};

using Elements = std::vector<Element>;
const Element* find(const Elements& elements, std::string_view name);

/// All elements of a file (ascii, binary_little_endian, binary_big_endian). Lists are passed over. Error: bad_input
/// naming line (header, ascii) or offset: what is no PLY, more rows than the file has bytes, a file that ends too
/// early.
Result<Elements> parse_elements(std::span<const std::byte> bytes, const std::string& where);

}  // namespace cuticle::strands::ply
