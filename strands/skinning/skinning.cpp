#include "strands/skinning/skinning.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "core/expect.h"

namespace cuticle::strands {

namespace {

double largest_difference(const glm::dmat3& a, const glm::dmat3& b) {
  double largest = 0;
  for (int k = 0; k < 9; ++k) largest = std::max(largest, std::abs(a[k / 3][k % 3] - b[k / 3][k % 3]));
  return largest;
}

/// The turn nearest to a matrix: Newton's iteration for the polar factor (Higham 1986). The identity where there is
/// none.
glm::dmat3 nearest_turn(const glm::dmat3& matrix) {
  glm::dmat3 turn = glm::determinant(matrix) < 0 ? -matrix : matrix;
  for (int step = 0; step < 60; ++step) {
    const double volume = glm::determinant(turn);
    if (!(volume > 1e-30) || !std::isfinite(volume)) return glm::dmat3(1);
    const glm::dmat3 next = 0.5 * (turn + glm::transpose(glm::inverse(turn)));
    const bool settled = largest_difference(next, turn) < 1e-15;
    turn = next;
    if (settled) break;
  }
  return turn;
}

Affine<float> affine(const glm::dmat3& linear, const glm::dvec3& origin) {
  return {glm::vec3(linear[0]), glm::vec3(linear[1]), glm::vec3(linear[2]), glm::vec3(origin)};
}

/// Turn q, then shift t: q + epsilon t q / 2.
DualQuaternion<float> dual_quaternion(const glm::dquat& q, const glm::dvec3& t) {
  const glm::dquat dual = glm::dquat(0, t.x, t.y, t.z) * q * 0.5;
  return {glm::vec3(glm::dvec3(q.x, q.y, q.z)), float(q.w), glm::vec3(glm::dvec3(dual.x, dual.y, dual.z)),
          float(dual.w)};
}

JointMotion joint_motion(const glm::dmat4& matrix) {
  const glm::dmat3 linear(matrix), turn = nearest_turn(linear);
  const glm::dvec3 shift(matrix[3]);
  return {affine(linear, shift), affine(glm::transpose(turn) * linear, glm::dvec3(0)),
          dual_quaternion(glm::normalize(glm::quat_cast(turn)), shift)};
}

/// The four joints' motions by their weights.
struct Blend {
  Affine<float> whole = no_affine<float>(), stretch = no_affine<float>();
  DualQuaternion<float> rigid = no_motion<float>();
};
Blend blend(const Influences& influences, std::span<const JointMotion> motions) {
  Blend sum;
  const JointMotion& pivot = motions[influences.joints[0]];
  for (int k = 0; k < 4; ++k) {
    const float weight = influences.weights[k];
    if (weight == 0) continue;
    const JointMotion& motion = motions[influences.joints[std::size_t(k)]];
    sum.whole = add_affine(sum.whole, motion.whole, weight);
    sum.stretch = add_affine(sum.stretch, motion.stretch, weight);
    sum.rigid = add_motion(sum.rigid, motion.rigid, pivot.rigid, weight);
  }
  sum.rigid = unit_motion(sum.rigid);
  return sum;
}

}  // namespace

std::vector<JointMotion> joint_motions(std::span<const glm::dmat4> matrices) {
  std::vector<JointMotion> motions;
  for (const glm::dmat4& matrix : matrices) motions.push_back(joint_motion(matrix));
  return motions;
}

void skin(const Mesh& bind, std::span<const Influences> influences, std::span<const JointMotion> motions,
          Skinning method, Mesh& moved) {
  CUTICLE_EXPECT(influences.size() == bind.positions.size(), "influences for each vertex");
  CUTICLE_EXPECT(
      std::ranges::all_of(influences,
                          [&](const Influences& vertex) { return std::ranges::max(vertex.joints) < motions.size(); }),
      "a joint that has no motion");
  moved.positions.resize(bind.positions.size());
  moved.normals.resize(bind.positions.size());
  for (std::size_t v = 0; v < bind.positions.size(); ++v) {
    const Blend b = blend(influences[v], motions);
    const glm::vec3 &place = bind.positions[v], &normal = bind.normals[v];
    const bool dual = method == Skinning::dual_quaternion;
    moved.positions[v] = dual ? motion_point(b.rigid, affine_point(b.stretch, place)) : affine_point(b.whole, place);
    const glm::vec3 turned =
        dual ? motion_direction(b.rigid, affine_normal(b.stretch, normal)) : affine_normal(b.whole, normal);
    moved.normals[v] = direction_or(turned, normal);
  }
}

}  // namespace cuticle::strands
