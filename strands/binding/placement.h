#pragma once
// A groom of another scale or place brought onto a mesh.
#include <span>

#include <glm/vec3.hpp>

#include "strands/binding/binding.h"

namespace cuticle::strands {

/// p -> scale p + shift.
struct Placement {
  double scale = 1;
  glm::dvec3 shift{0};
  double mean_distance = 0;  ///< of the placed roots from the mesh, metres
};

/// The uniform scale and shift that bring roots nearest to a mesh, from a first scale (1: the groom is in metres):
/// begun with the middle and the top of both at one place, then nearest points and least squares in turn, at most 60
/// times (iterated closest points; Besl and McKay 1992). It turns nothing: axes are a matter of convention. A local
/// minimum: roots that cover a small part of the mesh may slide. Error: bad_input when no triangle of the mesh has
/// area, or all roots are one point.
Result<Placement> fit_placement(std::span<const glm::vec3> roots, const Mesh& mesh, double first_scale);

/// Positions and radii of the groom, placed.
void place(Groom& groom, const Placement& placement);

}  // namespace cuticle::strands
