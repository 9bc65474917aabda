#include "core/json/position.h"

#include <algorithm>
#include <optional>

#include "core/json/json.h"

namespace cuticle {
namespace {

/// The byte after the string that begins at a quote.
std::size_t end_of_text(std::string_view text, std::size_t quote) {
  std::size_t at = quote + 1;
  for (; at < text.size() && text[at] != '"'; ++at)
    if (text[at] == '\\') ++at;
  return at + 1;
}

/// The byte after the comment that begins here; the same byte where none does.
std::size_t end_of_comment(std::string_view text, std::size_t at) {
  const std::string_view mark = text.substr(at, 2);
  if (mark == "//") return std::min(text.find('\n', at), text.size());
  if (mark == "/*") return std::min(text.find("*/", at + 2), text.size() - 2) + 2;
  return at;
}

/// Goes over a JSON text value by value.
class Walker {
 public:
  explicit Walker(std::string_view text) : text_(text) { skip_space(); }

  std::size_t at() const { return at_; }
  bool is_at(char c) const { return at_ < text_.size() && text_[at_] == c; }

  /// Into an object or a list.
  void enter() { step(); }
  /// To the next key or item; false at the end.
  bool has_next() {
    if (is_at(',')) step();
    return at_ < text_.size() && !is_at('}') && !is_at(']');
  }
  std::string key() {
    const std::size_t from = at_;
    skip_text();
    const auto parsed = Json::parse(text_.substr(from, at_ - from));
    skip_space();
    step();  // the colon
    return parsed && parsed->is_text() ? parsed->text() : std::string();
  }
  void skip_value() {
    int depth = 0;
    do {
      if (is_at('{') || is_at('[')) ++depth;
      if (is_at('}') || is_at(']')) --depth;
      if (is_at('"'))
        skip_text(), skip_space();
      else
        step();
    } while (at_ < text_.size() && (depth > 0 || !ends_value()));
  }

 private:
  bool ends_value() const { return is_at(',') || is_at('}') || is_at(']'); }
  void step() {
    ++at_;
    skip_space();
  }
  void skip_text() { at_ = end_of_text(text_, at_); }
  void skip_space() {
    at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Moves the walker to the value of a key or of a number; gives the byte where the key or item begins.
std::optional<std::size_t> descend(Walker& walker, const std::string& step) {
  const bool is_list = walker.is_at('[');
  if (!is_list && !walker.is_at('{')) return {};
  walker.enter();
  for (std::size_t i = 0; walker.has_next(); ++i) {
    const std::size_t start = walker.at();
    if (is_list ? std::to_string(i) == step : walker.key() == step) return start;
    walker.skip_value();
  }
  return {};
}

}  // namespace

TextPosition position_of(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte);
  const std::size_t last = before.rfind('\n');
  return {std::size_t(std::count(before.begin(), before.end(), '\n')) + 1,
          before.size() - (last == before.npos ? 0 : last + 1) + 1};
}

std::string without_comments(std::string_view text) {
  std::string result(text);
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '"') {
      at = end_of_text(text, at);
      continue;
    }
    const std::size_t end = end_of_comment(text, at);
    std::replace_if(result.begin() + std::ptrdiff_t(at), result.begin() + std::ptrdiff_t(end), [](char c) { return c != '\n'; }, ' ');
    at = std::max(end, at + 1);
  }
  return result;
}

std::size_t find_in_json(std::string_view text, std::span<const std::string> steps) {
  Walker walker(text);
  std::size_t found = walker.at();
  for (const std::string& step : steps) {
    const std::optional<std::size_t> next = descend(walker, step);
    if (!next) break;
    found = *next;
  }
  return found;
}

}  // namespace cuticle
