#include "strands/gltf/strands_glb.h"

#include <algorithm>
#include <filesystem>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "core/file.h"
#include "strands/gltf/glb.h"

namespace cuticle::strands {

namespace {

std::vector<std::uint32_t> segments_of(const Groom& groom) {
  std::vector<std::uint32_t> indices;
  indices.reserve(2 * (groom.vertex_count() - groom.strand_count()));
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v)
      indices.insert(indices.end(), {v, v + 1});
  return indices;
}

/// A value of each strand at all its vertices.
template <class T, class Value>
std::vector<T> at_vertices(const Groom& groom, Value value) {
  std::vector<T> values(groom.vertex_count());
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    std::fill(values.begin() + groom.offsets[s], values.begin() + groom.offsets[s + 1], value(s));
  return values;
}

std::vector<glm::vec4> tangents_of(const Groom& groom) {
  std::vector<glm::vec4> values;
  values.reserve(groom.vertex_count());
  for (const glm::vec3& tangent : tangents(groom)) values.emplace_back(tangent, 1.0f);
  return values;
}

std::vector<glm::vec2> radius_and_share(const Groom& groom) {
  std::vector<glm::vec2> values(groom.vertex_count());
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const double length = std::max(strand_length(groom, s), 1e-30);
    double passed = 0;
    for (std::uint32_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v) {
      if (v > groom.offsets[s]) passed += double(glm::distance(groom.positions[v - 1], groom.positions[v]));
      values[v] = {groom.radii[v], float(std::min(passed / length, 1.0))};
    }
  }
  return values;
}

glm::vec3 color_at(const Attribute& color, std::size_t row) {
  return {color.values[3 * row], color.values[3 * row + 1], color.values[3 * row + 2]};
}

bool is_color(const std::string& name, const Attribute& attribute) {
  return name == "color" && attribute.components == 3;
}

std::vector<glm::vec3> colors_of(const Groom& groom, const Attribute& color) {
  if (color.domain == Attribute::Domain::strand)
    return at_vertices<glm::vec3>(groom, [&](std::size_t s) { return color_at(color, s); });
  std::vector<glm::vec3> values(groom.vertex_count());
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = color_at(color, v);
  return values;
}

std::vector<std::string> what_is_lost(const Groom& groom) {
  std::vector<std::string> lost;
  for (const auto& [name, attribute] : groom.attributes)
    if (!is_color(name, attribute)) lost.push_back(fmt::format(".glb cannot hold the attribute '{}': dropped", name));
  if (!groom.root_triangle.empty()) lost.push_back(".glb cannot hold the triangles that the roots lie in: dropped");
  return lost;
}

Json attributes_of(GlbWriter& writer, const Groom& groom) {
  Json attributes{{"POSITION", writer.add_positions(groom.positions)}, {"TANGENT", writer.add(tangents_of(groom))}};
  attributes["TEXCOORD_0"] = writer.add(radius_and_share(groom));
  if (!groom.root_uv.empty())
    attributes["TEXCOORD_1"] =
        writer.add(at_vertices<glm::vec2>(groom, [&](std::size_t s) { return groom.root_uv[s]; }));
  const auto color = groom.attributes.find("color");
  if (color != groom.attributes.end() && is_color(color->first, color->second))
    attributes["COLOR_0"] = writer.add(colors_of(groom, color->second));
  return attributes;
}

/// Unlit, as the format has lines without normals (section 3.7.2.1): brown, unless the strands have a color.
Json material_of(const Groom& groom) {
  const auto color = groom.attributes.find("color");
  const bool has_color = color != groom.attributes.end() && is_color(color->first, color->second);
  const Json brown = Json::list({0.13, 0.07, 0.035, 1.0}), white = Json::list({1.0, 1.0, 1.0, 1.0});
  return {{"name", "hair"},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", has_color ? white : brown}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.4}}},
          {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
}

}  // namespace

Result<std::vector<std::string>> write_strands_glb(const std::string& path, const Groom& groom,
                                                   double metres_per_unit) {
  CUTICLE_TRY(validate(groom));
  if (groom.strand_count() == 0) return bad_input(fmt::format("{}: the groom has no strands", path));
  // The file's numbers are in its own unit, as in every format; the radius is too.
  Groom scaled = groom;
  if (metres_per_unit != 1) scale(scaled, 1 / metres_per_unit);
  GlbWriter writer;
  Json primitive{{"mode", 1}, {"material", 0}, {"attributes", attributes_of(writer, scaled)}};
  primitive["indices"] = writer.add_indices(segments_of(scaled));
  writer.extensions = {"KHR_materials_unlit"};
  const std::string name = std::filesystem::path(path).stem().string();
  CUTICLE_ASSIGN(const std::vector<std::byte> bytes, writer.file(name, primitive, material_of(groom), metres_per_unit));
  CUTICLE_TRY(write_file(path, bytes));
  return what_is_lost(groom);
}

}  // namespace cuticle::strands
