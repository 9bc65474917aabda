#include "strands/character/convention.h"

#include <cmath>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "core/file.h"
#include "core/json/json.h"

namespace cuticle::strands {

namespace {

Result<glm::dvec3> axis_of(std::string_view name, std::string_view key) {
  const std::string_view letters = "xyz";
  const bool is_signed = name.size() == 2 && (name[0] == '+' || name[0] == '-');
  const std::size_t axis = is_signed ? letters.find(name[1]) : std::string_view::npos;
  if (axis == std::string_view::npos)
    return bad_input(fmt::format("{}: '{}' is no axis; allowed: +x, -x, +y, -y, +z, -z", key, name.substr(0, 40)));
  glm::dvec3 direction{0};
  direction[int(axis)] = name[0] == '-' ? -1 : 1;
  return direction;
}

Result<void> read_bones(const Json& value, const std::string& where, Convention& convention) {
  if (!value.is_object()) return bad_input(fmt::format("{}: bones: expected an object of names", where));
  for (const auto& [ours, theirs] : value.items()) {
    if (!theirs.is_text()) return bad_input(fmt::format("{}: bones.{}: expected a name", where, ours));
    convention.bones[ours] = theirs.text();
  }
  return {};
}

Result<void> read_key(const std::string& key, const Json& value, const std::string& where, Convention& convention) {
  if (key == "bones") return read_bones(value, where, convention);
  if (key == "metres_per_unit") {
    if (value.is_number()) convention.metres_per_unit = value.number();
    if (value.is_number() && convention.metres_per_unit >= 0 && convention.metres_per_unit <= 1000) return {};
    return bad_input(
        fmt::format("{}: metres_per_unit = {}; allowed: 0 (guess) .. 1000", where, value.dump().substr(0, 40)));
  }
  if (key != "up" && key != "forward")
    return bad_input(fmt::format("{}: unknown key '{}'; known: metres_per_unit, up, forward, bones", where, key));
  if (!value.is_text()) return bad_input(fmt::format("{}: {}: expected an axis such as +y", where, key));
  (key == "up" ? convention.up : convention.forward) = value.text();
  return {};
}

}  // namespace

Result<Convention> parse_convention(std::string_view json, const std::string& where) {
  const Result<Json> parsed = Json::parse(json);
  if (!parsed || !parsed->is_object()) return bad_input(fmt::format("{}: not a JSON object", where));
  Convention convention;
  for (const auto& [key, item] : parsed->items()) CUTICLE_TRY(read_key(key, item, where, convention));
  CUTICLE_ASSIGN([[maybe_unused]] const glm::dmat4 turn, axes_to_ours(convention));
  return convention;
}

Result<Convention> read_convention(const std::string& path) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  return parse_convention(text, path);
}

Result<glm::dmat4> axes_to_ours(const Convention& convention) {
  CUTICLE_ASSIGN(const glm::dvec3 up, axis_of(convention.up, "up"));
  CUTICLE_ASSIGN(const glm::dvec3 forward, axis_of(convention.forward, "forward"));
  if (glm::dot(up, forward) != 0)
    return bad_input(fmt::format("up = {} and forward = {} lie along one axis", convention.up, convention.forward));
  return glm::dmat4(glm::transpose(glm::dmat3(glm::cross(up, forward), up, forward)));
}

UnitGuess guess_character_units(double longest_side) {
  struct Unit {
    double metres;
    const char* name;
  };
  constexpr Unit units[] = {
      {1, "metres"}, {0.01, "centimetres"}, {0.0254, "inches"}, {0.3048, "feet"}, {0.001, "millimetres"}};
  for (const Unit& unit : units)
    if (const double side = longest_side * unit.metres; side >= 0.1 && side <= 4)
      return {unit.metres, fmt::format("longest side of {:.4g} units: taken as {}", longest_side, unit.name)};
  return {1, fmt::format("longest side of {:.4g} units fits no known unit: taken as metres", longest_side)};
}

}  // namespace cuticle::strands
