#pragma once
// What stands about strands, as numbers: surfaces of colliders, the density of hair on a grid. Needs no VTK.
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"
#include "sim/colliders/placed.h"
#include "strands/groom.h"
#include "strands/mesh.h"

namespace cuticle::viz {

/// The surface of a sphere, capsule or box in the world, with about `parts` quads along each edge of a cube; flat faces
/// and straight sides are exact. Of a distance field none: it is drawn as its own level 0.
strands::Mesh surface_of(const sim::PlacedCollider& collider, int parts = 16);

/// Numbers at the nodes of a grid in the world, x fastest.
struct VolumeGrid {
  glm::ivec3 size{0};
  glm::dvec3 origin{0};
  double spacing = 1;  ///< metres
  std::vector<float> values;
};
/// Length of hair per volume, mm/mm^3 (so fibres per mm^2 across them), with the masses and weights of
/// "strand_interaction" on a grid of that cell (metres), of which the nodes about the hair are kept. Error: bad_input
/// for a cell that makes more than 2^22 nodes.
Result<VolumeGrid> hair_density(const strands::Groom& groom, double cell);

}  // namespace cuticle::viz
