// Reading the inputs of a case.
#include <cmath>
#include <limits>

#include "core/json/json.h"
#include "tests/hard_cases/subject.h"

namespace cuticle::hard_cases {
namespace {

double number(const Json& value) {
  if (!value.is_text()) return value.number();
  const std::string text = value.text();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  return text == "-inf" ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
}

void end_strand(strands::Groom& groom, float radius) {
  groom.radii.resize(groom.positions.size(), radius);
  groom.offsets.push_back(std::uint32_t(groom.positions.size()));
}

/// `count` parallel straight strands, `spacing` apart.
void add_lines(strands::Groom& groom, const Json& lines, float radius) {
  const glm::dvec3 from = vector(lines.at("from")), to = vector(lines.at("to"));
  const glm::dvec3 spacing = lines.contains("spacing") ? vector(lines.at("spacing")) : glm::dvec3(0);
  const int vertices = lines.value("vertices", 2), count = lines.value("count", 1);
  for (int s = 0; s < count; ++s) {
    for (int v = 0; v < vertices; ++v)
      groom.positions.emplace_back(from + double(s) * spacing + (to - from) * (double(v) / std::max(1, vertices - 1)));
    end_strand(groom, radius);
  }
}

}  // namespace

std::vector<double> numbers(const Json& value) {
  std::vector<double> list;
  if (value.is_list()) {
    for (const Json& item : value) list.push_back(number(item));
  } else if (value.is_object()) {
    const double from = value.at("from").number(), to = value.at("to").number();
    const int count = value.at("count").get<int>();
    for (int i = 0; i < count; ++i) list.push_back(from + (to - from) * i / (count - 1));
  } else {
    list.push_back(number(value));
  }
  return list;
}

glm::dvec3 vector(const Json& value) { return {number(value.at(0)), number(value.at(1)), number(value.at(2))}; }

strands::Groom groom_from(const Json& value) {
  strands::Groom groom;
  const float radius = value.value("radius", strands::k_default_radius);
  for (const Json& strand : value.value("points", Json::list())) {
    for (const Json& point : strand) groom.positions.emplace_back(vector(point));
    end_strand(groom, radius);
  }
  for (const Json& lines : value.value("lines", Json::list())) add_lines(groom, lines, radius);
  return groom;
}

Values coordinates(std::span<const glm::vec3> points) {
  Values values;
  for (const glm::vec3& point : points) values.insert(values.end(), {double(point.x), double(point.y), double(point.z)});
  return values;
}

}  // namespace cuticle::hard_cases
