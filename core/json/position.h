#pragma once
// Where in a JSON text a value stands, for messages about it.
#include <span>
#include <string>
#include <string_view>

namespace cuticle {

/// Both count from 1; a column is a byte.
struct TextPosition {
  std::size_t line = 1, column = 1;
};
/// Of a byte of the text.
TextPosition position_of(std::string_view text, std::size_t byte);

/// The text with its comments, `// to the end of the line` and `/* .. */`, overwritten by spaces: files that people
/// write may have them, and every place in the file stays what it was.
std::string without_comments(std::string_view text);

/// The byte at which the key or list item begins that the steps lead to: a key of an object, or an item's number of a
/// list. Of a key that is not there, the byte of the innermost object. The text must be JSON without comments.
std::size_t find_in_json(std::string_view text, std::span<const std::string> steps);

}  // namespace cuticle
