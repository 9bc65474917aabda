#pragma once
// Parameters as a plain struct with its defaults. Its `describe` says once what every member is; the table (--set, the
// scene's schema, Python, docs), reading and writing follow from that:
//   struct Wind { glm::dvec3 velocity{2, 0, 0}; double drag = 3; };
//   void describe(registry::Members& members, Wind& wind) {
//     members(wind.velocity, "velocity", "m/s", -100, 100, "of the air in world space, x/y/z");
//     members(wind.drag, "drag", "1/s", 0, 1000, "rate at which a free fibre takes on the air's velocity");
//   }
#include <concepts>
#include <deque>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/registry/parameter.h"

namespace cuticle::registry {

/// A row without type and default, which follow from the member.
constexpr Parameter row(std::string_view name, std::string_view unit, double minimum, double maximum,
                        std::string_view summary) {
  return {name, ParameterType::real, unit, minimum, maximum, {}, {}, summary};
}

/// What `describe` calls once a member, in the table's order. The member's type is the parameter's.
class Members {
 public:
  /// The value that a member is to have, from its row (without the default) and the value that it has.
  using Visit = std::function<Value(const Parameter& row, const Value& now)>;
  explicit Members(Visit visit) : visit_(std::move(visit)) {}

  /// A number or, for `glm::dvec3`, three of them, with unit and inclusive range.
  template <class T>
  void operator()(T& member, std::string_view name, std::string_view unit, double minimum, double maximum,
                  std::string_view summary) {
    (*this)(member, row(name, unit, minimum, maximum, summary));
  }
  /// An integer.
  template <std::integral T>
  void operator()(T& member, std::string_view name, double minimum, double maximum, std::string_view summary) {
    (*this)(member, row(name, "1", minimum, maximum, summary));
  }
  void operator()(bool& member, std::string_view name, std::string_view summary) {
    (*this)(member, row(name, "1", 0, 0, summary));
  }
  /// An enumeration whose values are places in `choices`, a boolean whose false and true have names, or a name.
  template <class T>
  requires std::is_enum_v<T> || std::same_as<T, bool> || std::same_as<T, std::string>
  void operator()(T& member, std::string_view name, std::span<const std::string_view> choices,
                  std::string_view summary) {
    Parameter named = row(name, "1", 0, 0, summary);
    named.choices = choices;
    (*this)(member, named);
  }
  /// The same of a row that several structs have; its type follows from the member.
  template <class T>
  void operator()(T& member, Parameter row) {
    if constexpr (std::is_enum_v<T>)
      member = T(meet_choice(row, std::size_t(member)));
    else if constexpr (std::is_same_v<T, bool>)
      member = row.choices.empty() ? std::get<bool>(meet(row, ParameterType::boolean, member))
                                   : meet_choice(row, std::size_t(member)) == 1;
    else if constexpr (std::is_same_v<T, std::string>)
      member = std::get<std::string>(meet(row, ParameterType::choice, member));
    else if constexpr (std::integral<T>)
      member = T(std::get<std::int64_t>(meet(row, ParameterType::integer, std::int64_t(member))));
    else if constexpr (std::floating_point<T>)
      member = T(std::get<double>(meet(row, ParameterType::real, in_decimal(member))));
    else
      member = std::get<glm::dvec3>(meet(row, ParameterType::rgb, member));
  }
  /// A length in metres that is given in millimetres.
  void millimetres(double& metres, std::string_view name, double minimum, double maximum, std::string_view summary) {
    double given = 1e3 * metres;
    (*this)(given, name, "mm", minimum, maximum, summary);
    metres = 1e-3 * given;
  }

 private:
  Value meet(Parameter& row, ParameterType type, const Value& now) const;
  std::size_t meet_choice(Parameter& row, std::size_t now) const;
  static double in_decimal(double value) { return value; }
  static double in_decimal(float value);  ///< 0.3f is 0.3

  Visit visit_;
};

/// Rows with the defaults of a struct, and the memory of their text.
class DescribedTable {
 public:
  explicit DescribedTable(const std::function<void(Members&)>& describe);
  ParameterTable rows() const { return rows_; }

 private:
  std::vector<Parameter> rows_;
  std::deque<std::string> defaults_;
};

/// How the values are given to members, or taken from them. Values must be those of the struct's table.
Members reader(const ParameterValues& values);
Members writer(ParameterValues& values);

/// The table of a struct that `describe` knows.
template <class T>
ParameterTable table_of() {
  static const DescribedTable table([](Members& members) {
    T defaults;
    describe(members, defaults);
  });
  return table.rows();
}

template <class T>
T from_values(const ParameterValues& values) {
  T read;
  Members members = reader(values);
  describe(members, read);
  return read;
}

/// "name=value,name=value" over the defaults. Errors: those of parse_assignments.
template <class T>
Result<T> parse(std::string_view text) {
  CUTICLE_ASSIGN(const ParameterValues values, parse_assignments(table_of<T>(), text));
  return from_values<T>(values);
}

template <class T>
ParameterValues to_values(T written) {
  ParameterValues values;
  Members members = writer(values);
  describe(members, written);
  return values;
}

}  // namespace cuticle::registry
