#pragma once
// H1: a growth mesh moved by joints, by linear blend or by dual quaternions.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "strands/mesh.h"
#include "strands/skinning/skinning.glslh"

namespace cuticle::strands {

enum class Skinning { linear_blend, dual_quaternion };

/// The joints that move a vertex, that of the greatest weight first; weights at least 0, of sum 1.
struct Influences {
  std::array<std::uint32_t, 4> joints{0, 0, 0, 0};
  glm::vec4 weights{1, 0, 0, 0};
};

/// What a joint did to the bind pose: `whole` = `rigid` after `stretch`. As the kernel reads it: 32 floats.
struct JointMotion {
  Affine<float> whole, stretch;
  DualQuaternion<float> rigid;
};
static_assert(sizeof(JointMotion) == 128);

/// Matrices (bind pose -> world, metres) split into turn, shift and stretch by polar decomposition. A matrix that
/// mirrors keeps its mirror in the stretch; one that flattens has no turn (the rigid part is then its shift alone).
std::vector<JointMotion> joint_motions(std::span<const glm::dmat4> matrices);

/// The bind pose moved. Stretch is blended linearly before the rigid part (Kavan et al. 2008, section 4.2), so that
/// dual quaternions follow joints that scale. Positions within 2e-6 of the mesh's size of the same formulas in double
/// (skinning_test). Triangles and texture coordinates of `moved` are those it had; positions and normals are written.
/// Every joint named by `influences` exists in `motions` (a broken promise otherwise).
void skin(const Mesh& bind, std::span<const Influences> influences, std::span<const JointMotion> motions,
          Skinning method, Mesh& moved);

}  // namespace cuticle::strands
