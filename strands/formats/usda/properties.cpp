#include <algorithm>

#include <fmt/core.h>

#include "strands/formats/tokens.h"
#include "strands/formats/usda/detail/properties.h"
#include "strands/formats/words.h"

namespace cuticle::strands::usda {

namespace {

/// Reads a USDA text token by token; what is not looked for is passed over.
class Parser {
 public:
  Parser(std::string_view text, const std::string& where) : tokens_(text), where_(where) {}

  Result<Stage> parse() {
    advance();
    if (token_.is('(')) CUTICLE_TRY(read_stage_metadata());
    while (token_.kind != Token::Kind::end) CUTICLE_TRY(read_statement());
    return std::move(stage_);
  }

 private:
  void advance() { token_ = tokens_.next(); }
  Error error(const std::string& what) const { return line_error(where_, tokens_.line(), what); }
  Error no_number() const { return error(fmt::format("'{}' is no number", token_.text.substr(0, 40))); }

  /// Passes over a bracket that may stand here.
  void skip(char open) {
    if (!token_.is(open)) return;
    tokens_.skip_brackets();
    advance();
  }

  Result<void> read_stage_metadata() {
    for (advance(); !token_.is(')') && token_.kind != Token::Kind::end;) {
      const std::string_view key = token_.kind == Token::Kind::word ? token_.text : "";
      advance();
      if (!token_.is('=')) continue;
      advance();
      if (key == "upAxis") stage_.up_axis = token_.text;
      if (key == "metersPerUnit") {
        const std::optional<double> metres = to_number(token_.text);
        if (!metres || !(*metres > 0 && *metres <= 1000))
          return error(fmt::format("metersPerUnit '{}', allowed above 0 .. 1000", token_.text.substr(0, 40)));
        stage_.metres_per_unit = *metres;
      }
      for (char open : {'(', '[', '{'})
        if (token_.is(open)) tokens_.skip_brackets();
      advance();
    }
    advance();
    return {};
  }

  Result<void> read_statement() {
    if (token_.is_word("def") || token_.is_word("over") || token_.is_word("class")) return read_prim();
    if (token_.is('}')) {
      if (!scopes_.empty()) scopes_.pop_back();
      advance();
      return {};
    }
    if (token_.is('{')) {
      scopes_.push_back(false);
      advance();
      return {};
    }
    if (token_.kind == Token::Kind::word && !scopes_.empty()) return read_property();
    advance();
    skip('(');
    return {};
  }

  /// `def Type "name" ( .. ) {`; the body's statements follow.
  Result<void> read_prim() {
    advance();
    const std::string_view type = token_.kind == Token::Kind::word ? token_.text : "";
    while (token_.kind == Token::Kind::word || token_.kind == Token::Kind::string) advance();
    skip('(');
    if (!token_.is('{')) return {};
    scopes_.push_back(type == "BasisCurves");
    if (scopes_.back()) stage_.curves.emplace_back();
    advance();
    return {};
  }

  /// `[custom] [uniform] type name [= value] [( metadata )]`.
  Result<void> read_property() {
    std::string_view type, name;
    while (token_.kind == Token::Kind::word && !token_.is_word("def")) {
      type = name;
      name = token_.text;
      advance();
      if (token_.is('[')) {  // of the type: "float[]"
        advance();
        if (token_.is(']')) advance();
      }
    }
    if (name.starts_with("xformOp")) stage_.has_transforms = true;
    if (!token_.is('=')) {
      skip('(');
      return {};
    }
    advance();
    const bool is_plain = name.find('.') == name.npos;
    if (name.ends_with(".timeSamples")) stage_.has_samples = true;
    Property property{std::string(type)};
    if (scopes_.back() && is_plain && property.components() > 0)
      CUTICLE_TRY(read_value(property));
    else
      skip_value(property);
    if (token_.is('(')) read_metadata(property);
    if (scopes_.back()) stage_.curves.back().insert_or_assign(std::string(name), std::move(property));
    return {};
  }

  void skip_value(Property& property) {
    property.text = token_.text;
    for (char open : {'[', '{', '('})
      if (token_.is(open)) tokens_.skip_brackets();
    advance();
  }

  /// A number, or numbers within brackets.
  Result<void> read_value(Property& property) {
    std::size_t depth = 0;
    do {
      if (token_.is('[') || token_.is('(')) {
        ++depth;
      } else if (token_.is(']') || token_.is(')')) {
        if (depth-- == 0) return no_number();
      } else if (!token_.is(',')) {
        const std::optional<double> number = token_.kind == Token::Kind::word ? to_number(token_.text) : std::nullopt;
        if (!number && !token_.is_word("None")) return no_number();
        if (number) property.numbers.push_back(*number);
      }
      advance();
    } while (depth > 0 && token_.kind != Token::Kind::end);
    return depth == 0 ? Result<void>() : error("the list is not closed");
  }

  void read_metadata(Property& property) {
    for (advance(); !token_.is(')') && token_.kind != Token::Kind::end;) {
      const std::string_view key = token_.kind == Token::Kind::word ? token_.text : "";
      advance();
      if (!token_.is('=')) continue;
      advance();
      if (key == "elementSize")
        property.element_size = std::size_t(std::clamp(to_number(token_.text).value_or(1), 1.0, 1e6));
      for (char open : {'(', '[', '{'})
        if (token_.is(open)) tokens_.skip_brackets();
      advance();
    }
    advance();
  }

  Tokens tokens_;
  Token token_;
  const std::string& where_;
  Stage stage_;
  std::vector<bool> scopes_;  ///< of every open brace, whether it is of BasisCurves
};

}  // namespace

std::size_t Property::components() const {
  static constexpr std::string_view whole[] = {"int", "uint", "int64", "uint64", "float", "double", "half"};
  if (std::find(std::begin(whole), std::end(whole), type) != std::end(whole)) return element_size;
  if (type.starts_with("matrix") || type.starts_with("quat") || type.starts_with("frame")) return 0;
  const std::size_t digit = type.find_first_of("234");
  return digit == type.npos ? 0 : std::size_t(type[digit] - '0') * element_size;
}

Result<Stage> parse_stage(std::string_view text, const std::string& where) {
  if (!text.starts_with("#usda")) return line_error(where, 1, "must begin with '#usda'");
  return Parser(text, where).parse();
}

}  // namespace cuticle::strands::usda
