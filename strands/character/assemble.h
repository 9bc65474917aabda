#pragma once
// What makes a character of the parts that a file holds, whatever its format.
#include "strands/character/character.h"

namespace cuticle::strands {

/// One influence as a file gives it. The joint is an index into Character::joints; `is_missing`: the file's skin lacks
/// it.
struct FileInfluence {
  std::uint32_t joint = 0;
  float weight = 0;
  bool is_missing = false;
};
/// A vertex as a file gives it.
struct FileVertex {
  glm::vec3 position{0};
  glm::vec2 uv{0};
  std::uint32_t first_joint = 0;  ///< of its skin
  std::vector<FileInfluence> influences = {};
};

/// Vertices at exactly one place become one, with the influences and texture coordinate of the first; normals are made
/// anew, smooth over the mesh. Writes mesh, influences and report; positions stay in file units.
void weld(std::span<const FileVertex> vertices, std::span<const std::array<std::uint32_t, 3>> triangles,
          Character& character);

/// Shift, turn and scale of a matrix without shear; a mirror becomes a negative scale.
void set_matrix(const glm::dmat4& matrix, Node& node);
/// Sets Character::order. Error: bad_input where nodes are their own ancestors.
Result<void> order_nodes(Character& character, const std::string& where);
/// Error: bad_input naming the key whose time falls, or whose time or value is not finite.
Result<void> check_keys(const Track& track, const std::string& where);
/// The mesh from file units and axes to metres and ours (`turn`: axes_to_ours); units are guessed where none are given.
void scale_to_metres(Character& character, const Convention& convention, const glm::dmat4& turn);

}  // namespace cuticle::strands
