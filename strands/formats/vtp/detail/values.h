#pragma once
// Numbers of a VTK XML file, in every encoding that VTK and ParaView write.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "core/result.h"

namespace cuticle::strands::vtp {

/// A VTK XML file: its elements, and the numbers of its arrays, which are text, base64 within the element, or appended
/// after it as base64 or as they are; whole or in blocks that zlib has compressed.
class VtkFile {
 public:
  /// Error: bad_input where the bytes are no XML, or are big-endian.
  Result<void> open(std::span<const std::byte> bytes, const std::string& where);
  pugi::xml_node root() const { return document_.child("VTKFile"); }
  /// The numbers of a DataArray. Error: bad_input naming file and array, and what is wrong or not understood.
  Result<std::vector<double>> numbers(pugi::xml_node array) const;
  /// bad_input "FILE: ARRAY: PROBLEM".
  Error error(const std::string& array, const std::string& problem) const;

 private:
  Result<std::string> bytes_of(pugi::xml_node array) const;
  Result<void> count_memory(const std::string& array, std::uint64_t bytes, std::string_view type) const;

  std::string where_;
  pugi::xml_document document_;
  std::string_view appended_;          ///< what follows the underscore of AppendedData
  mutable std::uint64_t memory_ = 0;  ///< what the arrays read so far have taken
};

}  // namespace cuticle::strands::vtp
