#pragma once
// Cards as triangles, in parts that are sorted as wholes.
#include "strands/cards/card_textures.h"
#include "strands/mesh.h"

namespace cuticle::strands {

/// Triangles of a mesh that share vertices, one after the other in its list.
struct MeshComponent {
  std::uint32_t first_triangle = 0, triangle_count = 0;
  float outside = 0;  ///< metres: mean distance of the surface from the head's middle and the line below it
};
/// A7: finds the connected components of a mesh and puts them inside to outside: by their distance from the half-line
/// that leads down (-y) from the head's center, through neck and body. Triangles keep their order within a component,
/// components as far from it as each other theirs.
std::vector<MeshComponent> sort_inside_to_outside(Mesh& mesh, const glm::vec3& center);

/// A card, or a part of one where it was cut.
struct CardPart {
  std::uint32_t card = 0, first_row = 0, row_count = 0;  ///< rows of CardMesh
  std::uint32_t group = 0;  ///< 0: on the head; from 1: parts that swing, those near each other alike
  std::uint32_t first_triangle = 0, triangle_count = 0;
};
inline constexpr std::uint32_t k_max_groups = 32;

/// Two vertices a row: 2 r at u = 0, 2 r + 1 at u = 1. Triangles look counter-clockwise from where the normals point
/// to.
struct CardMesh {
  Mesh mesh;                    ///< uv in the atlas; triangles in the static order
  std::vector<CardRow> rows;    ///< those of the cards; one where a card is cut stands twice
  std::vector<CardPart> parts;  ///< in the static order
};
/// `swings_from`: metres from the body's center at which a card is cut (A10: the rest is a part of a swinging group; a
/// card that begins there swings as a whole); 0: nowhere.
CardMesh make_card_mesh(const CardSet& set, const CardTextures& textures, const CardBody& body, double swings_from);

}  // namespace cuticle::strands
