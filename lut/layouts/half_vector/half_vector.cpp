#include <cmath>

#include <glm/geometric.hpp>

#include "lut/evaluate.h"
#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::half_vector {
namespace {

constexpr Channel solved(std::string_view name, int component) {
  return {name, bsdf::Quantity::S, "", component, Texel::for_filter, ChannelSource::solver};
}
constexpr Channel k_diffuse[] = {solved("diffuse.r", 0), solved("diffuse.g", 1), solved("diffuse.b", 2)};
constexpr Channel k_highlights[] = {solved("highlights.r", 0), solved("highlights.g", 1), solved("highlights.b", 2)};

/// From where the diffuse term is 0 on it is a straight line, which two texels hold.
constexpr Axis k_normal{AxisQuantity::cos_normal, -1.0 / 3, 1, true};
constexpr Axis k_azimuth{AxisQuantity::phi_half, 0, 2 * AngleAxes::right, true};
constexpr Axis k_inclination{AxisQuantity::theta_half, -AngleAxes::right, AngleAxes::right, true};
constexpr TableLayout k_tables[] = {{"diffuse", k_normal, k_no_axis, k_diffuse},
                                    {"highlights", k_azimuth, k_inclination, k_highlights}};
constexpr Term k_terms[] = {{{"diffuse"}}, {{"highlights"}}};
constexpr std::string_view k_systems[] = {"A4", "A5"};

/// A viewer at phi = 0 and a light with that vector halfway between them: the viewer as near to it as phi = 0 allows.
/// Components: along the fibre, toward the viewer, across.
bsdf::Point around(double inclination, double azimuth) {
  constexpr double k_least = 1e-4;  // of an inclination whose viewer looks along the fibre
  const bool is_behind = azimuth > AngleAxes::right;
  if (is_behind) inclination = std::copysign(std::max(std::abs(inclination), k_least), inclination);
  const double wide = std::cos(inclination);
  const glm::dvec3 half(std::sin(inclination), wide * std::cos(azimuth), wide * std::sin(azimuth));
  const glm::dvec3 viewer = is_behind ? glm::dvec3(std::copysign(1.0, half.x), 0, 0)
                                      : glm::normalize(glm::dvec3(half.x, std::max(half.y, 1e-12), 0));
  const glm::dvec3 light = 2 * glm::dot(viewer, half) * half - viewer;
  bsdf::Point at;
  at.theta_i = std::atan2(light.x, std::hypot(light.y, light.z));
  at.theta_o = std::atan2(viewer.x, viewer.y);
  at.theta_d = (at.theta_o - at.theta_i) / 2;
  at.phi = std::atan2(light.z, light.y);
  return at;
}

/// S of some lobes at the points of a table's texels.
Result<void> fill(const Source& source, Table& table, std::string_view lobes, const std::vector<bsdf::Point>& points) {
  const Channel any{"S", bsdf::Quantity::S, lobes, 0};
  CUTICLE_ASSIGN(const std::vector<glm::dvec3> values, evaluate_points(*source.model, source.evaluate, any, points));
  const int width = table.image.width;
  for (int i = 0; i < int(values.size()); ++i)
    for (int c = 0; c < 3; ++c) table.image.at(i % width, i / width, c) = float(values[std::size_t(i)][c]);
  suit_to_filter(table);
  return {};
}

Result<void> solve(const Source& source, TableSet& set, Progress&) {
  const auto value = [&](const Axis& axis, int texel) { return axis_value(axis, set.size, (texel + 0.5) / set.size); };
  std::vector<bsdf::Point> lit, around_fibre;
  for (int x = 0; x < set.size; ++x) {
    bsdf::Point& at = lit.emplace_back();
    at.phi = std::acos(value(k_normal, x));
  }
  for (int y = 0; y < set.size; ++y)
    for (int x = 0; x < set.size; ++x) around_fibre.push_back(around(value(k_inclination, y), value(k_azimuth, x)));
  CUTICLE_TRY(fill(source, set.tables[0], "diffuse", lit));
  return fill(source, set.tables[1], "primary+secondary", around_fibre);
}

}  // namespace

const Layout& entry() {
  static const Layout layout{
      .entry = {.kind = registry::EntryKind::layout,
                .name = "half_vector",
                .summary = "scheuermann by what it depends on: highlights over the half vector, a row of the diffuse term "
                           "over the cosine to the normal",
                .source = "ours, of Scheuermann 2004",
                .systems = k_systems},
      .tables = k_tables,
      .composition = "S = diffuse + highlights",
      .terms = k_terms,
      .family = "half_vector",
      .model = "scheuermann",
      .solve = solve};
  return layout;
}

}  // namespace cuticle::lut::half_vector
