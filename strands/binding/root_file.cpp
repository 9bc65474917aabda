#include "strands/binding/root_file.h"

#include <cmath>

#include <fmt/core.h>

#include "core/file.h"
#include "strands/formats/words.h"

namespace cuticle::strands {

namespace {

/// Lines of a text with their numbers.
class Lines {
 public:
  Lines(std::string_view text, const std::string& where) : text_(text), where_(where) {}

  Result<std::size_t> count() {
    std::string_view line = next();
    std::size_t value = 0;
    if (parse_whole(next_word(line), value) && next_word(line).empty()) return value;
    return line_error(where_, 1, "expected the number of roots");
  }
  Result<glm::vec3> vector() {
    std::string_view line = next();
    glm::vec3 value(0);
    for (int k = 0; k < 3; ++k)
      if (!parse_whole(next_word(line), value[k]) || !std::isfinite(value[k]))
        return line_error(where_, number_, "expected three finite numbers");
    return value;
  }
  /// How many lines there can be at most.
  std::size_t room() const { return text_.size() / 2 + 1; }

 private:
  std::string_view next() {
    ++number_;
    return next_line(text_);
  }
  std::string_view text_;
  const std::string& where_;
  std::size_t number_ = 0;
};

}  // namespace

Result<RootPlaces> parse_root_places(std::string_view text, const std::string& where) {
  Lines lines(text, where);
  CUTICLE_ASSIGN(const std::size_t count, lines.count());
  if (count == 0 || count > lines.room() / 2)
    return bad_input(
        fmt::format("{}: {} roots; allowed: 1 .. {} in a file of its size", where, count, lines.room() / 2));
  RootPlaces roots;
  for (std::size_t i = 0; i < count; ++i) {
    CUTICLE_ASSIGN(const glm::vec3 position, lines.vector());
    CUTICLE_ASSIGN(const glm::vec3 normal, lines.vector());
    roots.positions.push_back(position);
    roots.normals.push_back(normal);
  }
  return roots;
}

Result<RootPlaces> read_root_places(const std::string& path) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  return parse_root_places(text, path);
}

}  // namespace cuticle::strands
