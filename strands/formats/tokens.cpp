#include "strands/formats/tokens.h"

#include <algorithm>

namespace cuticle::strands {

namespace {
constexpr std::string_view k_marks = "()[]{}=,;", k_space = " \t\r\n";
}

void Tokens::skip_space() {
  while (!text_.empty()) {
    const char first = text_.front();
    if (first != '#' && k_space.find(first) == k_space.npos) return;
    line_ += first == '\n';
    text_.remove_prefix(first == '#' ? std::min(text_.find('\n'), text_.size()) : 1);
  }
}

Token Tokens::take(Token::Kind kind, std::size_t begin, std::size_t length, std::size_t after) {
  const Token token{kind, text_.substr(begin, length)};
  after = std::min(after, text_.size());
  line_ += std::size_t(std::count(text_.begin(), text_.begin() + std::ptrdiff_t(after), '\n'));
  text_.remove_prefix(after);
  return token;
}

Token Tokens::next() {
  skip_space();
  if (text_.empty()) return {};
  const char first = text_.front();
  if (k_marks.find(first) != k_marks.npos) return take(Token::Kind::mark, 0, 1, 1);
  if (first == '"' || first == '\'') {
    const std::string_view triple = first == '"' ? "\"\"\"" : "'''";
    const std::size_t quotes = text_.starts_with(triple) ? 3 : 1;
    const std::size_t end = std::min(text_.find(triple.substr(0, quotes), quotes), text_.size());
    return take(Token::Kind::string, quotes, end - quotes, end + quotes);
  }
  std::size_t end = 0;
  while (end < text_.size() && k_marks.find(text_[end]) == k_marks.npos && k_space.find(text_[end]) == k_space.npos &&
         text_[end] != '"' && text_[end] != '#')
    ++end;
  return take(Token::Kind::word, 0, end, end);
}

void Tokens::skip_brackets() {
  for (std::size_t depth = 1; depth > 0;) {
    const Token token = next();
    if (token.kind == Token::Kind::end) return;
    if (token.is('(') || token.is('[') || token.is('{')) ++depth;
    if (token.is(')') || token.is(']') || token.is('}')) --depth;
  }
}

}  // namespace cuticle::strands
