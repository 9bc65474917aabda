#pragma once
// Many numbers as text, each in its shortest form that reads back, written by all threads.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace cuticle::strands {

/// What stands around the numbers of a row and between rows.
struct RowText {
  std::string_view open = {}, between = " ", close = {}, after = "\n";
};

/// Appends the values, `components` (at least 1) a row; the last row may be shorter. Behind the last row `after` stands
/// too.
void append_rows(std::string& text, std::span<const float> values, std::size_t components, const RowText& form);
void append_rows(std::string& text, std::span<const std::uint32_t> values, std::size_t components, const RowText& form);

}  // namespace cuticle::strands
