#pragma once
// Words, strings and marks of a text whose line breaks mean nothing (pbrt, USDA). Comments run from # to the line's
// end.
#include <cstddef>
#include <string_view>

namespace cuticle::strands {

struct Token {
  enum class Kind { end, word, string, mark } kind = Kind::end;
  std::string_view text;  ///< of a string, without its quotes; of a mark, one character
  bool is(char mark) const { return kind == Kind::mark && text.front() == mark; }
  bool is_word(std::string_view word) const { return kind == Kind::word && text == word; }
};

/// Marks are ( ) [ ] { } = , ; and each is a token of its own. A string that is not closed runs to the end of the text.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : text_(text) {}
  Token next();
  /// Takes tokens up to the mark that closes the bracket that was just taken.
  void skip_brackets();
  std::size_t line() const { return line_; }

 private:
  void skip_space();
  Token take(Token::Kind kind, std::size_t begin, std::size_t length, std::size_t after);
  std::string_view text_;
  std::size_t line_ = 1;
};

}  // namespace cuticle::strands
