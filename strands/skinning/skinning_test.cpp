// Linear blend and dual quaternions against matrices and closed forms in double.
#include "strands/skinning/skinning.h"

#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/random.h"

namespace cuticle::strands::skinning_test {
namespace {

constexpr double k_pi = std::numbers::pi;
constexpr Skinning k_methods[] = {Skinning::linear_blend, Skinning::dual_quaternion};

Mesh cloud(std::size_t count) {
  RandomStream random(1);
  const auto number = [&] { return float(2 * random.next_unit() - 1); };
  Mesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    mesh.positions.emplace_back(number(), number(), number());
    mesh.normals.push_back(unit_or_up(glm::dvec3(number(), number(), number())));
  }
  return mesh;
}

glm::dmat4 turn(double angle, const glm::dvec3& axis = {0, 0, 1}) { return glm::rotate(glm::dmat4(1), angle, axis); }

Mesh skinned(const Mesh& mesh, const Influences& all, std::span<const glm::dmat4> matrices, Skinning method) {
  Mesh moved;
  skin(mesh, std::vector<Influences>(mesh.positions.size(), all), joint_motions(matrices), method, moved);
  return moved;
}

double largest_distance(const Mesh& moved, const Mesh& bind, const glm::dmat4& matrix) {
  double largest = 0;
  for (std::size_t i = 0; i < bind.positions.size(); ++i)
    largest = std::max(
        largest, glm::distance(glm::dvec3(moved.positions[i]), glm::dvec3(matrix * glm::dvec4(bind.positions[i], 1))));
  return largest;
}

TEST(Skinning, OneJoint_BothMethodsFollowItsMatrix) {
  const glm::dmat4 rigid =
      glm::translate(glm::dmat4(1), {1, -2, 0.5}) * turn(2.5, glm::normalize(glm::dvec3(1, 2, -3)));
  const glm::dmat4 sheared = rigid * glm::scale(glm::dmat4(1), {2, 0.5, 1.5}) * turn(0.7, {1, 0, 0});
  for (const glm::dmat4& matrix : {glm::dmat4(1), rigid, sheared, glm::scale(rigid, {-1, 1, 1})})
    for (Skinning method : k_methods) {
      const Mesh mesh = cloud(200);
      EXPECT_LT(largest_distance(skinned(mesh, {}, std::vector{matrix}, method), mesh, matrix), 2e-6);
    }
}

TEST(Skinning, TwoTurnsAboutOneAxis_DualQuaternionsTurnByTheMean) {
  const Mesh mesh = cloud(200);
  const Influences half{{0, 1, 0, 0}, {0.5f, 0.5f, 0, 0}};
  for (double angle : {0.5, 2.0, k_pi - 1e-3}) {
    const std::vector matrices{turn(0.2), turn(0.2 + angle)};
    EXPECT_LT(largest_distance(skinned(mesh, half, matrices, Skinning::dual_quaternion), mesh, turn(0.2 + angle / 2)),
              1e-6);
  }
}

TEST(Skinning, TurnsThatDifferByMoreThanHalf_DualQuaternionsTakeTheShortWay) {
  const Mesh mesh = cloud(50);
  const Influences half{{0, 1, 0, 0}, {0.5f, 0.5f, 0, 0}};
  const std::vector matrices{turn(-80 * k_pi / 180), turn(120 * k_pi / 180)};  // 160 degrees apart over the back
  EXPECT_LT(largest_distance(skinned(mesh, half, matrices, Skinning::dual_quaternion), mesh, turn(200 * k_pi / 180)),
            1e-6);
}

TEST(Skinning, TwoTurnsAboutOneAxis_LinearBlendShrinksByTheCosineOfHalfTheAngle) {
  const Mesh mesh = cloud(200);
  const Influences half{{0, 1, 0, 0}, {0.5f, 0.5f, 0, 0}};
  for (double angle : {0.5, 2.0, k_pi}) {
    const std::vector matrices{turn(-angle / 2), turn(angle / 2)};
    const double shrunk = std::cos(angle / 2);
    const glm::dmat4 expected = glm::scale(glm::dmat4(1), {shrunk, shrunk, 1});
    EXPECT_LT(largest_distance(skinned(mesh, half, matrices, Skinning::linear_blend), mesh, expected), 1e-6);
  }
}

TEST(Skinning, Shifts_BothMethodsMixThemAlike) {
  const Mesh mesh = cloud(50);
  const Influences mixed{{0, 1, 2, 3}, {0.4f, 0.3f, 0.2f, 0.1f}};
  std::vector<glm::dmat4> matrices;
  glm::dvec3 mean{0};
  for (int k = 0; k < 4; ++k) {
    const glm::dvec3 shift(k, 1 - k, 0.5 * k * k);
    mean += double(mixed.weights[k]) * shift;
    matrices.push_back(glm::translate(glm::dmat4(1), shift));
  }
  for (Skinning method : k_methods)
    EXPECT_LT(largest_distance(skinned(mesh, mixed, matrices, method), mesh, glm::translate(glm::dmat4(1), mean)),
              1e-6);
}

TEST(Skinning, UnevenScale_NormalsStayAtRightAnglesToTheSurface) {
  Mesh mesh;  // a plane x + y = 1 with two tangents
  mesh.positions = {{1, 0, 0}, {0, 1, 0}, {1, 0, 1}};
  mesh.normals.assign(3, glm::normalize(glm::vec3(1, 1, 0)));
  const std::vector matrices{turn(0.8, {0, 1, 0}) * glm::scale(glm::dmat4(1), {3, 0.5, 2})};
  for (Skinning method : k_methods) {
    const Mesh moved = skinned(mesh, {}, matrices, method);
    for (int k = 1; k < 3; ++k)
      EXPECT_NEAR(glm::dot(moved.positions[std::size_t(k)] - moved.positions[0], moved.normals[0]), 0, 1e-6);
    EXPECT_NEAR(glm::length(moved.normals[0]), 1, 1e-6);
  }
}

TEST(Skinning, FlatteningOrHugeMatrices_StayFinite) {
  const Mesh mesh = cloud(20);
  const Influences half{{0, 1, 0, 0}, {0.5f, 0.5f, 0, 0}};
  for (const glm::dmat4& odd :
       {glm::dmat4(0), glm::scale(glm::dmat4(1), {1, 0, 1}), glm::scale(glm::dmat4(1), glm::dvec3(1e9))})
    for (Skinning method : k_methods) {
      const Mesh moved = skinned(mesh, half, std::vector{glm::dmat4(1), odd}, method);
      for (std::size_t i = 0; i < 20; ++i)
        EXPECT_TRUE(std::isfinite(glm::dot(moved.positions[i], moved.positions[i]) + glm::length(moved.normals[i])));
    }
}

TEST(Skinning, FormulaInFloat_IsThatInDouble) {
  RandomStream random(3);
  const auto number = [&] { return 2 * random.next_unit() - 1; };
  double largest = 0;
  for (int i = 0; i < 2000; ++i) {
    const DualQuaternion<double> q{{number(), number(), number()}, number(), {number(), number(), number()}, number()};
    const DualQuaternion<float> f{glm::vec3(q.axis), float(q.real), glm::vec3(q.dual_axis), float(q.dual)};
    const double size = q.real * q.real + glm::dot(q.axis, q.axis);
    if (size < 0.1) continue;
    const glm::dvec3 p(number(), number(), number());
    const glm::dvec3 exact = motion_point(unit_motion(q), p);
    largest = std::max(largest, glm::distance(exact, glm::dvec3(motion_point(unit_motion(f), glm::vec3(p)))) /
                                    (1 + glm::length(exact)));
  }
  EXPECT_LT(largest, 2e-6);
}

}  // namespace
}  // namespace cuticle::strands::skinning_test
