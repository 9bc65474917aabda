#pragma once
// From a scalp to hair: control hairs planted on the vertices along the normals, combed, then interpolated to drawn strands.
#include <cuticle/core/registry/parameter.h>
#include <cuticle/core/result.h>
#include <cuticle/core/view.h>
#include <cuticle/strands/groom.h>
#include <cuticle/strands/mesh.h>

namespace cuticle::strands {

/// A head: the whole mesh (drawn, collided with), and its scalp region as a mesh of its own whose triangles carry hair.
struct Head {
  Mesh mesh;
  Mesh scalp;
  std::vector<Sphere> colliders;   ///< spheres that approximate the head, for the simulator
};
/// The procedural head: about 0.23 m tall, facing +z, y up, neck joint at the origin, scalp of `scalp_vertices` about.
Head make_head(int scalp_vertices = 300);

/// Length, segments, growth of segment length, comb direction, droop, ... each with unit and range.
registry::ParameterTable growing_parameters();

/// N1, N6: one control hair per scalp vertex, along its normal, segment lengths growing away from the head, then combed
/// and kept outside the head's colliders.
Result<Groom> plant_control_hairs(const Head& head, const registry::ParameterValues& growing);

/// N5: for each drawn strand a scalp triangle (by area) and barycentric weights from two folded random numbers (Philox, seeded).
struct Root {
  std::uint32_t triangle = 0;
  glm::vec3 weights{1, 0, 0};      ///< of the triangle's three control hairs; sum 1
};
std::vector<Root> scatter_roots(const Mesh& scalp, std::size_t count, std::uint64_t seed);

/// For a groom of its own (a file): each strand is its own control hair; `triangle` is then the strand, the weights are 1, 0, 0.
std::vector<Root> identity_roots(std::size_t strand_count);

}  // namespace cuticle::strands
