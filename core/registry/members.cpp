#include "core/registry/members.h"

#include <algorithm>
#include <charconv>

namespace cuticle::registry {
namespace {

/// The shortest decimal that reads as the number: "0.3", "3.9e9".
template <class Real>
std::string shortest(Real value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  std::string text(digits, end);
  for (const char* padding : {"e+0", "e+", "e-0"})
    if (const std::size_t at = text.find(padding); at != std::string::npos)
      text.replace(at, std::string_view(padding).size(), padding[1] == '-' ? "e-" : "e");
  return text;
}

std::string typed(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return shortest(*number);
  if (const auto* v = std::get_if<glm::dvec3>(&value))
    return v->x == v->y && v->y == v->z ? shortest(v->x) : shortest(v->x) + "/" + shortest(v->y) + "/" + shortest(v->z);
  return to_text(value);
}

}  // namespace

double Members::in_decimal(float value) {
  const std::string digits = shortest(value);
  double read = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), read);
  return read;
}

Value Members::meet(Parameter& row, ParameterType type, const Value& now) const {
  row.type = type;
  return visit_(row, now);
}

std::size_t Members::meet_choice(Parameter& row, std::size_t now) const {
  row.type = ParameterType::choice;
  const Value chosen = visit_(row, std::string(row.choices[now]));
  return std::size_t(std::ranges::find(row.choices, std::get<std::string>(chosen)) - row.choices.begin());
}

DescribedTable::DescribedTable(const std::function<void(Members&)>& describe) {
  Members members([this](const Parameter& row, const Value& now) {
    rows_.push_back(row);
    rows_.back().default_text = defaults_.emplace_back(typed(now));
    return now;
  });
  describe(members);
}

Members reader(const ParameterValues& values) {
  return Members([&values](const Parameter& row, const Value& now) -> Value {
    const auto found = values.all().find(row.name);
    CUTICLE_EXPECT(found != values.all().end(), "values hold every parameter of their table");
    return found == values.all().end() ? now : found->second;
  });
}

Members writer(ParameterValues& values) {
  return Members([&values](const Parameter& row, const Value& now) {
    values.set(row.name, now);
    return now;
  });
}

}  // namespace cuticle::registry
