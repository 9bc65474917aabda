#pragma once
// Arrays of a VTK XML file in text.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "strands/groom.h"

namespace cuticle::strands {

/// An array of floats, each in its shortest form: they read back bit by bit.
void append_array(std::string& text, std::string_view name, int components, std::span<const float> values);
void append_array(std::string& text, std::string_view name, std::span<const glm::vec3> values);
/// An array of whole numbers, one a line; type as VTK names it.
void append_array(std::string& text, std::string_view type, std::string_view name,
                  std::span<const std::uint32_t> values);
/// Connectivity and offsets: a polyline per strand of two or more vertices.
void append_lines(std::string& text, const Groom& groom);
/// Strands of two or more vertices.
std::size_t line_count(const Groom& groom);

/// What stands before and after the arrays of a PolyData file of one piece.
std::string open_piece(std::size_t points, std::size_t lines);
std::string_view close_piece();

}  // namespace cuticle::strands
