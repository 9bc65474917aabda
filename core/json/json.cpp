#include "core/json/json.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/json/position.h"
#include "core/text.h"

namespace cuticle {

using Library = nlohmann::ordered_json;

/// To the library's value, and from its parser.
struct Json::Convert {
  static Library to(const Json& value);
  class Builder;
};

Library Json::Convert::to(const Json& value) {
  switch (value.kind_) {
    case Kind::boolean:
      return value.boolean_;
    case Kind::whole:
      return value.whole_;
    case Kind::positive:
      return value.positive_;
    case Kind::real:
      return value.real_;
    case Kind::text:
      return value.text_;
    case Kind::list: {
      Library list = Library::array();
      for (const Json& item : value.values_) list.push_back(to(item));
      return list;
    }
    case Kind::object: {
      Library object = Library::object();
      // Past the map's own functions, which look at every key before they add one.
      auto& pairs = static_cast<Library::object_t::Container&>(object.get_ref<Library::object_t&>());
      for (const auto& [key, item] : value.items()) pairs.emplace_back(key, to(item));
      return object;
    }
    default:
      return nullptr;
  }
}

/// Takes a text piece by piece from the library's parser. Its own objects look at every key before they add one, and
/// keep one of two equal keys in silence.
class Json::Convert::Builder {
 public:
  explicit Builder(std::string_view text) : text_(text) {}
  bool null() { return add(Json()); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(std::int64_t value) { return add(value); }
  bool number_unsigned(std::uint64_t value) { return add(value); }
  bool number_float(double value, const std::string&) { return add(value); }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(Library::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::list()); }
  bool end_array() {
    open_.pop_back();
    return true;
  }
  bool key(std::string& name) {
    open_.back()->keys_.push_back(std::move(name));
    return true;
  }
  bool end_object() {
    std::vector<std::string_view> names(open_.back()->keys_.begin(), open_.back()->keys_.end());
    open_.pop_back();
    std::ranges::sort(names);
    const auto twice = std::ranges::adjacent_find(names);
    if (twice == names.end()) return true;
    problem_ = "the key " + in_quotes(*twice) + " is given twice";
    return false;
  }
  bool parse_error(std::size_t byte, const std::string&, const Library::exception& error) {
    constexpr int k_not_json = 101;
    const TextPosition place = position_of(text_, std::max<std::size_t>(byte, 1) - 1);
    problem_ = error.id == k_not_json ? "not JSON at line " + std::to_string(place.line) + ", column " +
                                            std::to_string(place.column)
                                      : error.what();
    return false;
  }

  Json take() { return std::move(root_); }
  const std::string& problem() const { return problem_; }

 private:
  static constexpr std::size_t k_deepest = 256;

  Json* place() {
    if (open_.empty()) return &root_;
    return &open_.back()->values_.emplace_back();
  }
  bool add(Json value) {
    *place() = std::move(value);
    return true;
  }
  /// Without the bound, a text of brackets alone would end the program: values are copied level by level.
  bool open(Json empty) {
    if (open_.size() == k_deepest) problem_ = "more than 256 levels";
    if (!problem_.empty()) return false;
    open_.push_back(place());
    *open_.back() = std::move(empty);
    return true;
  }

  std::string_view text_;
  Json root_;
  std::vector<Json*> open_;  ///< lists and objects from the outside in; what lies in one moves only once it is closed
  std::string problem_;
};

namespace {

template <class Value>
const Value& held(const Value* value, const char* expected, const Json& found) {
  if (value) return *value;
  throw Json::Mismatch(std::string("expected ") + expected + ", found " + found.dump().substr(0, 40));
}

bool is_pair_with_key(const Json& item) { return item.is_list() && item.size() == 2 && item[0].is_text(); }

}  // namespace

Json::Json(std::initializer_list<Json> items) : kind_(Kind::list) {
  if (!std::all_of(items.begin(), items.end(), is_pair_with_key)) {
    values_ = items;
    return;
  }
  kind_ = Kind::object;
  for (const Json& item : items) (*this)[item[0].text_] = item[1];
}

Json Json::list(std::initializer_list<Json> items) {
  Json json;
  json.kind_ = Kind::list;
  json.values_ = items;
  return json;
}

Json Json::object() {
  Json json;
  json.kind_ = Kind::object;
  return json;
}

Result<Json> Json::parse(std::string_view text) {
  Convert::Builder builder(text);
  if (Library::sax_parse(text.begin(), text.end(), &builder)) return builder.take();
  return bad_input(builder.problem(), "check commas, quotes and brackets there");
}

std::string Json::dump(int indent, bool ascii) const {
  return Convert::to(*this).dump(indent, ' ', ascii, Library::error_handler_t::replace);
}

const char* Json::type_name() const {
  static constexpr const char* k_names[] = {"null",   "boolean", "number", "number",
                                            "number", "string",  "array",  "object"};
  return k_names[int(kind_)];
}

bool Json::boolean() const { return held(is_boolean() ? &boolean_ : nullptr, "true or false", *this); }

double Json::number() const {
  if (kind_ == Kind::whole) return double(whole_);
  if (kind_ == Kind::positive) return double(positive_);
  return held(kind_ == Kind::real ? &real_ : nullptr, "a number", *this);
}

std::int64_t Json::whole() const {
  if (kind_ == Kind::real) return std::int64_t(real_);
  return held(is_whole() ? &whole_ : nullptr, "a number", *this);
}

const std::string& Json::text() const { return held(is_text() ? &text_ : nullptr, "a text", *this); }

Json::Items Json::items() const {
  Items items;
  items.reserve(keys_.size());
  for (std::size_t i = 0; i < keys_.size(); ++i) items.emplace_back(keys_[i], values_[i]);
  return items;
}

const Json* Json::find(std::string_view key) const {
  const auto found = std::find(keys_.begin(), keys_.end(), key);
  return found == keys_.end() ? nullptr : &values_[std::size_t(found - keys_.begin())];
}

const Json& Json::at(std::string_view key) const {
  if (const Json* found = find(key)) return *found;
  throw Mismatch("'" + std::string(key) + "' is missing");
}

const Json& Json::at(std::size_t place) const {
  return held(place < size() ? &values_[place] : nullptr, "a longer list", *this);
}

const Json& Json::operator[](std::string_view key) const {
  const Json* found = find(key);
  CUTICLE_EXPECT(found, "the key is there");
  return *found;
}

const Json& Json::operator[](std::size_t place) const {
  CUTICLE_EXPECT(place < values_.size(), "the place is there");
  return values_[place];
}

Json& Json::operator[](std::size_t place) { return const_cast<Json&>(std::as_const(*this)[place]); }

Json& Json::operator[](std::string_view key) {
  CUTICLE_EXPECT(is_null() || is_object(), "an object");
  kind_ = Kind::object;
  if (const Json* found = find(key)) return const_cast<Json&>(*found);
  keys_.emplace_back(key);
  return values_.emplace_back();
}

void Json::push_back(Json value) {
  CUTICLE_EXPECT(is_null() || is_list(), "a list");
  kind_ = Kind::list;
  values_.push_back(std::move(value));
}

void Json::erase(std::string_view key) {
  const auto found = std::find(keys_.begin(), keys_.end(), key);
  if (found == keys_.end()) return;
  values_.erase(values_.begin() + (found - keys_.begin()));
  keys_.erase(found);
}

void Json::update(const Json& other) {
  for (const auto& [key, value] : other.items()) (*this)[key] = value;
}

bool operator==(const Json& a, const Json& b) {
  if (a.is_number() && b.is_number())
    return a.is_whole() && b.is_whole() && a.kind_ == b.kind_ ? a.whole_ == b.whole_ : a.number() == b.number();
  return a.kind_ == b.kind_ && (a.kind_ != Json::Kind::boolean || a.boolean_ == b.boolean_) && a.text_ == b.text_ &&
         a.keys_ == b.keys_ && a.values_ == b.values_;
}

void Json::set_boolean(bool value) {
  kind_ = Kind::boolean;
  boolean_ = value;
}
void Json::set_whole(std::int64_t value) {
  kind_ = Kind::whole;
  whole_ = value;
}
void Json::set_positive(std::uint64_t value) {
  kind_ = Kind::positive;
  positive_ = value;
}

}  // namespace cuticle
