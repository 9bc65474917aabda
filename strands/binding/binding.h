#pragma once
// Roots bound to a growth mesh by triangle and barycentrics, and strands that follow it.
#include <array>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "core/result.h"
#include "strands/growing/growing.h"
#include "strands/statistics.h"

namespace cuticle::strands {

/// How well the roots of a groom fit a mesh.
struct BindingReport {
  Spread distance;                       ///< of the roots from the mesh, metres
  std::size_t far_strands = 0;           ///< whose root lies more than `far` from it; bound all the same
  std::size_t empty_strands = 0;         ///< without a vertex: bound to triangle 0
  std::size_t degenerate_triangles = 0;  ///< without area: nothing is bound to them
};
/// Roots at the nearest points of the mesh. `far`: metres. Error: bad_input when no triangle of the mesh has area.
struct Binding {
  std::vector<Root> roots;  ///< one per strand
  BindingReport report;
};
Result<Binding> bind_roots(const Groom& groom, const Mesh& mesh, double far);

/// Places and unit normals of the mesh at roots, one vertex each; no triangles.
Mesh mesh_at_roots(const Mesh& mesh, std::span<const Root> roots);

/// The strands moved, without turning, so that each begins at its root's place on the mesh.
void move_roots_onto(Groom& groom, const Mesh& mesh, std::span<const Root> roots);

/// H2: strands at rest, as what their roots' frames see of them: the same arrays for carry() and for the kernel.
struct RestOnMesh {
  std::vector<std::array<std::uint32_t, 4>> corners;  ///< per strand: vertices of its triangle; 0
  std::vector<glm::vec4> weights;                     ///< per strand: of the corners; 0
  std::vector<glm::vec4> locals;                      ///< per vertex: in the root's frame, metres; 0
  std::vector<std::uint32_t> strand_of;               ///< per vertex
};
RestOnMesh rest_on_mesh(const Groom& groom, const Mesh& mesh, std::span<const Root> roots);

/// Where the strands are when the mesh they rest on has moved: rigid in the frames of their roots; a strand whose root
/// lay on the mesh begins on it, within rounding (binding_test: 1e-6 of the mesh's size).
void carry(const RestOnMesh& rest, const Mesh& moved, std::span<glm::vec3> positions);

}  // namespace cuticle::strands
