#pragma once
// A JSON value. nlohmann's parser and writer do the work in json.cpp; this header declares what our sources use of them
// without their templates, which cost each source that included them some ten seconds to compile.
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/result.h"

namespace cuticle {

/// null, true or false, a number (whole or not), a text, a list, or an object, whose keys keep the order in which they
/// came. A braced list becomes an object where each item is a list of two that begins with a text, else a list.
class Json {
 public:
  enum class Kind { null, boolean, whole, positive, real, text, list, object };
  /// A value of another kind than was asked for, or none. Whoever reads a file catches it and names the file.
  struct Mismatch : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  using Items = std::vector<std::pair<const std::string&, const Json&>>;

  Json() = default;
  Json(std::nullptr_t) {}
  Json(const char* text) : kind_(Kind::text), text_(text) {}
  Json(std::string text) : kind_(Kind::text), text_(std::move(text)) {}
  Json(std::string_view text) : kind_(Kind::text), text_(text) {}
  Json(double value) : kind_(Kind::real), real_(value) {}
  Json(float value) : Json(double(value)) {}
  template <class T>
  requires std::is_integral_v<T> Json(T value) {
    if constexpr (std::is_same_v<T, bool>)
      set_boolean(value);
    else if constexpr (std::is_signed_v<T>)
      set_whole(value);
    else
      set_positive(value);
  }
  /// A list of what the range holds.
  template <class Range>
  requires(!std::is_same_v<Range, Json>) && requires(const Range& range) { Json(*range.begin()); }
  Json(const Range& range) : kind_(Kind::list) {
    for (const auto& item : range) values_.emplace_back(item);
  }
  Json(std::initializer_list<Json> items);
  static Json list(std::initializer_list<Json> items = {});
  static Json object();

  /// One whole JSON text. Error: bad_input, with line and column where it is none; more than 256 levels
  /// are too deep.
  static Result<Json> parse(std::string_view text);
  /// indent < 0: one line. Numbers are written so that they read back equal, infinite ones and NaN as null; bytes that
  /// are no UTF-8 become U+FFFD.
  std::string dump(int indent = -1, bool ascii = false) const;

  /// "null", "boolean", "number", "string", "array" or "object": JSON's own words.
  const char* type_name() const;
  bool is_null() const { return kind_ == Kind::null; }
  bool is_boolean() const { return kind_ == Kind::boolean; }
  bool is_number() const { return is_whole() || kind_ == Kind::real; }
  bool is_whole() const { return kind_ == Kind::whole || kind_ == Kind::positive; }
  bool is_text() const { return kind_ == Kind::text; }
  bool is_list() const { return kind_ == Kind::list; }
  bool is_object() const { return kind_ == Kind::object; }

  /// What it holds; numbers of every kind convert into each other. Throws Mismatch.
  bool boolean() const;
  double number() const;
  std::int64_t whole() const;
  const std::string& text() const;
  template <class T>
  T get() const {
    if constexpr (std::is_same_v<T, Json>)
      return *this;
    else if constexpr (std::is_same_v<T, bool>)
      return boolean();
    else if constexpr (std::is_integral_v<T>)
      return T(whole());
    else if constexpr (std::is_floating_point_v<T>)
      return T(number());
    else
      return text();
  }

  /// Items of a list or an object; 0 for all else.
  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  std::vector<Json>::const_iterator begin() const { return values_.begin(); }
  std::vector<Json>::const_iterator end() const { return values_.end(); }
  std::vector<Json>::iterator begin() { return values_.begin(); }
  std::vector<Json>::iterator end() { return values_.end(); }
  Items items() const;  ///< keys and values of an object; they live as long as this does

  /// The value of a key: null pointer where there is none or this is no object.
  const Json* find(std::string_view key) const;
  bool contains(std::string_view key) const { return find(key) != nullptr; }
  /// Throws Mismatch where there is none.
  const Json& at(std::string_view key) const;
  const Json& at(std::size_t place) const;
  /// The value of a key, else `otherwise`. Throws Mismatch.
  template <class T>
  T value(std::string_view key, T otherwise) const {
    const Json* found = find(key);
    return found ? found->get<T>() : otherwise;
  }
  /// The key and the place must be there.
  const Json& operator[](std::string_view key) const;
  const Json& operator[](std::size_t place) const;
  Json& operator[](std::size_t place);
  /// Made where it is not there; null becomes an object.
  Json& operator[](std::string_view key);
  /// Adds to a list; null becomes one.
  void push_back(Json value);
  /// Takes a key away, if it is there.
  void erase(std::string_view key);
  /// Sets every key of another object.
  void update(const Json& other);

  /// Numbers are equal by value; objects if their keys and values come in the same order.
  friend bool operator==(const Json& a, const Json& b);

 private:
  struct Convert;
  void set_boolean(bool value);
  void set_whole(std::int64_t value);
  void set_positive(std::uint64_t value);

  Kind kind_ = Kind::null;
  union {
    bool boolean_;
    std::int64_t whole_;
    std::uint64_t positive_;
    double real_ = 0;
  };
  std::string text_;
  std::vector<std::string> keys_;  ///< of an object, one for each of values_
  std::vector<Json> values_;
};

}  // namespace cuticle
