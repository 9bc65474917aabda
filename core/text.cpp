#include "core/text.h"

#include <array>
#include <cstdint>

#include <fmt/core.h>

namespace cuticle {
namespace {

/// Bytes of the character at the front (RFC 3629), 0 where they are no UTF-8; its number.
std::size_t decode(std::string_view text, std::uint32_t& number) {
  const auto byte = [&](std::size_t i) { return std::uint32_t(std::uint8_t(text[i])); };
  number = byte(0);
  if (number < 0x80) return 1;
  const std::size_t size = number >= 0xf0 ? 4 : number >= 0xe0 ? 3 : 2;
  constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  if (number < 0xc2 || number > 0xf4 || text.size() < size) return 0;
  number &= 0xffu >> (size + 1);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    number = number << 6 | (byte(i) & 0x3f);
  }
  return number < least[size] || number > 0x10ffff || (number >= 0xd800 && number < 0xe000) ? 0 : size;
}

/// What a terminal obeys instead of showing it.
bool is_obeyed(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7f && c < 0xa0) || (c >= 0x200b && c <= 0x200f) || (c >= 0x2028 && c <= 0x202e) ||
         (c >= 0x2060 && c <= 0x206f) || c == 0xfeff;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::string shown;
  while (!text.empty() && shown.size() < most) {
    std::uint32_t number = 0;
    const std::size_t size = decode(text, number);
    if (size == 0)
      shown += fmt::format("\\x{:02x}", std::uint8_t(text[0]));
    else if (number == '\n')
      shown += "\\n";
    else if (is_obeyed(number))
      shown += number < 0x80 ? fmt::format("\\x{:02x}", number) : fmt::format("\\u{:04x}", number);
    else
      shown += text.substr(0, size);
    text.remove_prefix(size == 0 ? 1 : size);
  }
  if (!text.empty()) shown += fmt::format(".. ({} more bytes)", text.size());
  return shown;
}

std::string in_quotes(std::string_view word) { return fmt::format("'{}'", printable(word, 60)); }

}  // namespace cuticle
