#pragma once
// Text from files, as it may be shown.
#include <cstddef>
#include <string>
#include <string_view>

namespace cuticle {

/// The text as valid UTF-8 without what a terminal obeys: control characters (also those of U+0080 .. U+009F), marks that
/// turn the direction of writing, line breaks and bytes that are no UTF-8 become \n, \x1b, \u202e ..; what is longer
/// than `most` bytes is cut, and says by how much. What can be read is kept.
std::string printable(std::string_view text, std::size_t most = 2000);

/// A word that a file gave, short enough to stand in a message: cut at 60 bytes.
std::string in_quotes(std::string_view word);

}  // namespace cuticle
