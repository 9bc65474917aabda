#include "strands/cards/hair_cards.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/file.h"
#include "core/json/json.h"
#include "core/mapped_file.h"
#include "strands/cards/cards_glb.h"
#include "strands/cards/occlusion.h"

namespace cuticle::strands {

namespace {

constexpr const char* k_material =
    "newmtl hair\nKd 1 1 1\nmap_Kd base.png\nmap_d alpha.png\n# shift.png: specular shift, 0.5 is none; mask.png: "
    "noise "
    "of the secondary highlight\n";

/// Texture coordinates of OBJ rise upward; row 0 of the textures, the roots, is on top.
std::string obj_text(const HairCards& cards) {
  const Mesh& mesh = cards.mesh.mesh;
  std::string text =
      "# metres; vertex colours: ambient occlusion; groups and faces inside to outside\nmtllib cards.mtl\n";
  const auto out = std::back_inserter(text);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::vec3 &p = mesh.positions[v], &n = mesh.normals[v];
    fmt::format_to(out, "v {} {} {} {:.4f} {:.4f} {:.4f}\nvn {:.6f} {:.6f} {:.6f}\nvt {:.6f} {:.6f}\n", p.x, p.y, p.z,
                   cards.occlusion[v], cards.occlusion[v], cards.occlusion[v], n.x, n.y, n.z, mesh.uv[v].x,
                   1 - mesh.uv[v].y);
  }
  text += "usemtl hair\n";
  for (std::size_t p = 0; p < cards.mesh.parts.size(); ++p) {
    const CardPart& part = cards.mesh.parts[p];
    fmt::format_to(out, "g part_{}_group_{}\n", p, part.group);
    for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
      const auto [a, b, c] = mesh.triangles[t];
      fmt::format_to(out, "f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", a + 1, b + 1, c + 1);
    }
  }
  return text;
}

Image channel(const Image& atlas, int number) {
  Image image = make_image(atlas.width, atlas.height, {"Y"});
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
    image.pixels[p] = atlas.pixels[p * std::size_t(atlas.channels()) + std::size_t(number)];
  return image;
}

Json kinds_of(const HairCards& cards) {
  Json kinds = Json::list();
  for (std::size_t k = 0; k < cards.textures.kinds.size(); ++k) {
    const CardKind& kind = cards.textures.kinds[k];
    const auto uses = std::ranges::count(cards.set.cards, std::uint32_t(k), &Card::kind);
    kinds.push_back({{"cards", uses},
                     {"baked_from_card", kind.card},
                     {"coverage_of_strands", kind.coverage},
                     {"strand_width", kind.strand_width},
                     {"mean_alpha", kind.alpha},
                     {"opaque_share", kind.opaque}});
  }
  return kinds;
}

std::size_t group_count(const CardMesh& mesh) {
  std::uint32_t most = 0;
  for (const CardPart& part : mesh.parts) most = std::max(most, part.group);
  return most + 1;
}

CardBody body_of(const Groom& groom, const Mesh* head) {
  if (!head || head->positions.empty()) return body_of_roots(groom);
  glm::dvec3 sum(0);
  for (const glm::vec3& position : head->positions) sum += position;
  return {glm::vec3(sum / double(head->positions.size()))};
}

}  // namespace

Result<HairCards> make_hair_cards(const Groom& groom, const Mesh* head, const CardParameters& parameters) {
  const CardBody body = body_of(groom, head);
  HairCards cards;
  CUTICLE_ASSIGN(cards.set, make_cards(groom, body, parameters));
  cards.textures = bake_textures(groom, cards.set, parameters);
  cards.mesh = make_card_mesh(cards.set, cards.textures, body, parameters.swings_from);
  cards.occlusion =
      ambient_occlusion(groom, head, cards.mesh.mesh.positions, cards.mesh.mesh.normals, parameters.occlusion_rays);
  return cards;
}

std::string card_report(const HairCards& cards) {
  const Json json = {{"cards", cards.set.cards.size()},
                     {"parts", cards.mesh.parts.size()},
                     {"sort_groups", group_count(cards.mesh)},
                     {"vertices", cards.mesh.mesh.positions.size()},
                     {"triangles", cards.mesh.mesh.triangles.size()},
                     {"cover_error",
                      {{"outside_share", cards.set.error.outside},
                       {"distance_m", cards.set.error.distance},
                       {"card_area_over_strand_area", cards.set.error.area},
                       {"kind_coverage", cards.textures.kind_error}}},
                     {"texture_px", Json::list({cards.textures.atlas.width, cards.textures.atlas.height})},
                     {"kinds", kinds_of(cards)}};
  return json.dump(2) + "\n";
}

Result<void> write_cards(const std::string& folder, const HairCards& cards) {
  const Image& atlas = cards.textures.atlas;
  for (int c = 0; c < atlas.channels(); ++c)
    CUTICLE_TRY(write_png(fmt::format("{}/{}.png", folder, atlas.channel_names[std::size_t(c)]), channel(atlas, c)));
  CUTICLE_TRY(write_png(folder + "/cards.png", card_picture(cards.textures)));
  CUTICLE_ASSIGN(const FileBytes picture, map_file(folder + "/cards.png"));
  CUTICLE_ASSIGN(const std::vector<std::byte> glb, cards_glb(cards, picture.span()));
  CUTICLE_TRY(write_file(folder + "/cards.glb", glb));
  CUTICLE_TRY(write_text_file(folder + "/cards.mtl", k_material));
  CUTICLE_TRY(write_text_file(folder + "/cards.obj", obj_text(cards)));
  return write_text_file(folder + "/cards.json", card_report(cards));
}

}  // namespace cuticle::strands
