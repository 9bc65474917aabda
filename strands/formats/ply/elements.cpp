#include <algorithm>
#include <cstring>

#include <fmt/core.h>

#include "strands/formats/bytes.h"
#include "strands/formats/ply/detail/elements.h"
#include "strands/formats/words.h"

namespace cuticle::strands::ply {

namespace {

struct Type {
  std::string_view names[2];
  char kind;
  int bytes;
};
constexpr Type k_types[] = {{{"char", "int8"}, 'i', 1},     {{"uchar", "uint8"}, 'u', 1},
                            {{"short", "int16"}, 'i', 2},   {{"ushort", "uint16"}, 'u', 2},
                            {{"int", "int32"}, 'i', 4},     {{"uint", "uint32"}, 'u', 4},
                            {{"float", "float32"}, 'f', 4}, {{"double", "float64"}, 'f', 8}};

/// A property with what a list needs beside: the type of its length.
struct Stored {
  Type item, length;
};

class Parser {
 public:
  Parser(std::span<const std::byte> bytes, const std::string& where)
      : bytes_(bytes), where_(where), text_(to_text(bytes)) {}

  Result<Elements> parse() {
    CUTICLE_TRY(read_header());
    offset_ = bytes_.size() - text_.size();
    for (std::size_t e = 0; e < elements_.size(); ++e) CUTICLE_TRY(read_rows(elements_[e], stored_[e]));
    return std::move(elements_);
  }

 private:
  Error error(const std::string& what) const { return line_error(where_, line_, what); }

  std::string_view take_line() {
    ++line_;
    return next_line(text_);
  }

  Result<void> read_header() {
    std::string_view line = take_line();
    if (next_word(line) != "ply") return error("must be 'ply'");
    for (line = take_line(); !text_.empty(); line = take_line()) {
      const std::string_view word = next_word(line);
      if (word == "end_header") return has_format_ ? Result<void>() : error("no line 'format'");
      if (word == "format") CUTICLE_TRY(read_format(line));
      if (word == "element") CUTICLE_TRY(read_element(line));
      if (word == "property") CUTICLE_TRY(read_property(line));
    }
    return error("no line 'end_header'");
  }

  Result<void> read_format(std::string_view line) {
    const std::string_view word = next_word(line);
    has_format_ = true;
    is_text_ = word == "ascii";
    is_big_ = word == "binary_big_endian";
    if (is_text_ || is_big_ || word == "binary_little_endian") return {};
    return error(
        fmt::format("format '{}', allowed ascii, binary_little_endian, binary_big_endian", word.substr(0, 40)));
  }

  Result<void> read_element(std::string_view line) {
    const std::string_view name = next_word(line), word = next_word(line);
    const std::optional<double> rows = to_number(word);
    if (!rows || !(*rows >= 0 && *rows <= double(bytes_.size())))
      return error(fmt::format("'{}' rows of {}, allowed 0 .. {} in a file of so many bytes", word.substr(0, 40),
                               name.substr(0, 40), bytes_.size()));
    elements_.push_back({std::string(name), std::size_t(*rows)});
    stored_.emplace_back();
    return {};
  }

  Result<Type> read_type(std::string_view word) const {
    for (const Type& type : k_types)
      if (word == type.names[0] || word == type.names[1]) return type;
    return error(fmt::format("type '{}' is not one of PLY's", word.substr(0, 40)));
  }

  Result<void> read_property(std::string_view line) {
    if (elements_.empty()) return error("property before the first element");
    if (elements_.back().properties.size() == 1000) return error("more than 1000 properties");
    Property property;
    std::string_view word = next_word(line);
    Stored stored{};
    property.is_list = word == "list";
    if (property.is_list) {
      CUTICLE_ASSIGN(stored.length, read_type(next_word(line)));
      word = next_word(line);
    }
    CUTICLE_ASSIGN(stored.item, read_type(word));
    property.kind = stored.item.kind;
    property.bytes = stored.item.bytes;
    property.name = next_word(line);
    elements_.back().properties.push_back(std::move(property));
    stored_.back().push_back(stored);
    return {};
  }

  Result<void> read_rows(Element& element, const std::vector<Stored>& stored) {
    if (element.properties.empty() || element.rows == 0) return {};
    std::size_t row_bytes = 0;
    for (std::size_t p = 0; p < stored.size(); ++p)
      row_bytes += std::size_t(is_text_                        ? 1
                               : element.properties[p].is_list ? stored[p].length.bytes
                                                               : stored[p].item.bytes);
    const std::size_t left = is_text_ ? text_.size() : bytes_.size() - offset_;
    if (element.rows > left / row_bytes)
      return error(fmt::format("{} rows of {} need {} bytes each, {} are left in the file", element.rows, element.name,
                               row_bytes, left));
    for (Property& property : element.properties)
      if (!property.is_list) property.values.reserve(element.rows);
    for (std::size_t row = 0; row < element.rows; ++row)
      for (std::size_t p = 0; p < stored.size(); ++p)
        CUTICLE_TRY(read_property_of_row(element.properties[p], stored[p]));
    return {};
  }

  Result<void> read_property_of_row(Property& property, const Stored& stored) {
    double value = 0;
    if (!property.is_list) {
      CUTICLE_TRY(read_number(property, stored.item, value));
      property.values.push_back(value);
      return {};
    }
    double length = 0;
    CUTICLE_TRY(read_number(property, stored.length, length));
    for (double i = 0; i < length; ++i) CUTICLE_TRY(read_number(property, stored.item, value));
    return {};
  }

  Result<void> read_number(const Property& property, const Type& type, double& value) {
    if (is_text_) return read_word(property, value);
    const ByteView view(bytes_, where_);
    const std::size_t size = std::size_t(type.bytes);
    if (!view.has(offset_, size)) return view.error(property.name, offset_, "the file ends before it");
    std::byte raw[8];
    std::memcpy(raw, bytes_.data() + offset_, size);
    if (is_big_) std::reverse(raw, raw + size);
    offset_ += size;
    value = decoded(raw, type);
    return {};
  }

  Result<void> read_word(const Property& property, double& value) {
    while (row_.empty() && !text_.empty()) {
      row_ = take_line();
      row_.remove_prefix(std::min(row_.find_first_not_of(" \t\r"), row_.size()));
    }
    const std::string_view word = next_word(row_);
    row_.remove_prefix(std::min(row_.find_first_not_of(" \t\r"), row_.size()));
    const std::optional<double> read = to_number(word);
    if (!read) return error(fmt::format("{}: '{}' is no number", property.name, word.substr(0, 40)));
    value = *read;
    return {};
  }

  template <class T>
  static double as(const std::byte* raw) {
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return double(value);
  }
  static double decoded(const std::byte* raw, const Type& type) {
    if (type.kind == 'f') return type.bytes == 4 ? as<float>(raw) : as<double>(raw);
    if (type.kind == 'i')
      return type.bytes == 1 ? as<std::int8_t>(raw) : type.bytes == 2 ? as<std::int16_t>(raw) : as<std::int32_t>(raw);
    return type.bytes == 1 ? as<std::uint8_t>(raw) : type.bytes == 2 ? as<std::uint16_t>(raw) : as<std::uint32_t>(raw);
  }

  std::span<const std::byte> bytes_;
  const std::string& where_;
  std::string_view text_, row_;
  std::size_t line_ = 0, offset_ = 0;
  bool has_format_ = false, is_text_ = false, is_big_ = false;
  Elements elements_;
  std::vector<std::vector<Stored>> stored_;  ///< of each element's properties
};

}  // namespace

const Property* Element::find(std::string_view property) const {
  for (const Property& candidate : properties)
    if (candidate.name == property && !candidate.is_list) return &candidate;
  return nullptr;
}

const Element* find(const Elements& elements, std::string_view name) {
  for (const Element& element : elements)
    if (element.name == name) return &element;
  return nullptr;
}

Result<Elements> parse_elements(std::span<const std::byte> bytes, const std::string& where) {
  return Parser(bytes, where).parse();
}

}  // namespace cuticle::strands::ply
