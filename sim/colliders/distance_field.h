#pragma once
// A mesh as a collider: its signed distance at the nodes of a grid.
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"
#include "strands/mesh.h"

namespace cuticle::sim {

/// Cubes of `spacing` around a mesh, two of them beyond it on every side; between the nodes the distance is trilinear.
/// Moves as a Sphere does.
struct DistanceField {
  glm::dvec3 centre{0};       ///< of the grid, metres
  double spacing = 0;         ///< metres
  glm::ivec3 cells{0};        ///< along x, y, z; one node more than cells
  std::vector<float> values;  ///< of the nodes, x fastest; metres, negative inside
  /// Largest difference from the true distance at the middles of the cubes that the surface passes through, metres.
  double error = 0;
};

inline constexpr double k_largest_spacing = 1000;
inline constexpr std::size_t k_max_field_nodes = std::size_t(1) << 24;

/// The distance from the nearest triangle; negative where the surface winds around a node, counted exactly along lines
/// through the nodes, so that closed surfaces may overlap (their union) and may be turned inside out. mesh: metres,
/// closed: at every edge as many triangles run one way as the other, places that are equal being one vertex. `where`:
/// names the mesh in errors. Error: bad_input for a spacing outside 0 .. 1000 m, more than 2^24 nodes, a place that is
/// not finite, an index out of range, no triangle with area, open edges (their number, and where the first lies), or no
/// node inside.
Result<DistanceField> bake_distance_field(const strands::Mesh& mesh, double spacing, const std::string& where);

}  // namespace cuticle::sim
