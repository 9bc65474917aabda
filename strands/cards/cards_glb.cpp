#include "strands/cards/cards_glb.h"

#include <glm/geometric.hpp>

#include "strands/gltf/glb.h"

namespace cuticle::strands {

namespace {

/// Where a mask cuts the strands' coverage.
constexpr double k_cutoff = 0.5;
// The picture is grey: brown hair, until a program is told another color. Roughness: of the lobe along a strand; across
// it, the highlight of a fibre is as wide as can be.
constexpr double k_roughness = 0.45, k_anisotropy = 0.9, k_quarter_turn = 1.5707963267948966;

/// A value of each row at its two vertices.
template <class T, class Value>
std::vector<T> at_both(const CardMesh& mesh, Value value) {
  std::vector<T> values;
  values.reserve(2 * mesh.rows.size());
  for (const CardRow& row : mesh.rows) values.insert(values.end(), 2, value(row));
  return values;
}

std::vector<std::uint32_t> indices_of(const Mesh& mesh) {
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
  return indices;
}

Json attributes_of(GlbWriter& writer, const HairCards& cards) {
  const Mesh& mesh = cards.mesh.mesh;
  std::vector<glm::vec3> occlusion;
  for (const float value : cards.occlusion) occlusion.emplace_back(value);
  const auto along = [](const CardRow& row) { return glm::vec4(row.tangent, 1.0f); };
  return {{"POSITION", writer.add_positions(mesh.positions)},
          {"NORMAL", writer.add(mesh.normals)},
          {"TANGENT", writer.add(at_both<glm::vec4>(cards.mesh, along))},
          {"TEXCOORD_0", writer.add(mesh.uv)},
          {"COLOR_0", writer.add(occlusion)}};
}

Json material_of(std::size_t texture) {
  return {
      {"name", "hair"},
      {"doubleSided", true},
      {"alphaMode", "MASK"},
      {"alphaCutoff", k_cutoff},
      {"pbrMetallicRoughness",
       {{"baseColorTexture", {{"index", texture}}},
        {"baseColorFactor", Json::list({0.32, 0.2, 0.1, 1.0})},
        {"metallicFactor", 0.0},
        {"roughnessFactor", k_roughness}}},
      {"extensions",
       {{"KHR_materials_anisotropy", {{"anisotropyStrength", k_anisotropy}, {"anisotropyRotation", k_quarter_turn}}}}}};
}

}  // namespace

Image card_picture(const CardTextures& textures) {
  const Image& atlas = textures.atlas;
  Image picture = make_image(atlas.width, atlas.height, {"R", "G", "B", "A"});
  for (int y = 0; y < atlas.height; ++y)
    for (int x = 0; x < atlas.width; ++x) {
      for (int c = 0; c < 3; ++c) picture.at(x, y, c) = atlas.at(x, y, 0);
      picture.at(x, y, 3) = atlas.at(x, y, 3);
    }
  return picture;
}

Result<std::vector<std::byte>> cards_glb(const HairCards& cards, std::span<const std::byte> picture) {
  GlbWriter writer;
  writer.extensions = {"KHR_materials_anisotropy"};
  Json primitive{{"mode", 4}, {"material", 0}, {"attributes", attributes_of(writer, cards)}};
  primitive["indices"] = writer.add_indices(indices_of(cards.mesh.mesh));
  return writer.file("cards", primitive, material_of(writer.add_png(picture)), 1);
}

}  // namespace cuticle::strands
