// Nearest points against all triangles and against dense samples; bound strands against the mesh they follow.
#include "strands/binding/binding.h"

#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/random.h"
#include "strands/binding/nearest_triangle.h"
#include "strands/binding/placement.h"

namespace cuticle::strands::binding_test {
namespace {

glm::dvec3 random_point(RandomStream& random, double size = 1) {
  const auto number = [&] { return size * (2 * random.next_unit() - 1); };
  const double x = number(), y = number();
  return {x, y, number()};
}

Mesh soup(std::size_t triangles) {
  RandomStream random(2);
  Mesh mesh;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const glm::dvec3 centre = random_point(random);
    for (int k = 0; k < 3; ++k) mesh.positions.emplace_back(centre + random_point(random, 0.2));
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  compute_normals(mesh);
  return mesh;
}

/// An egg of rings about y; upper part only up to `share` of the way from the top.
Mesh egg(double share = 1) {
  Mesh mesh;
  constexpr std::uint32_t rings = 24, sectors = 36;
  for (std::uint32_t i = 0; i <= rings; ++i)
    for (std::uint32_t k = 0; k < sectors; ++k) {
      const double polar = share * std::numbers::pi * (i + 0.05) / (rings + 0.1),
                   azimuth = 2 * std::numbers::pi * k / sectors;
      mesh.positions.emplace_back(0.075 * std::sin(polar) * std::cos(azimuth), 0.11 * std::cos(polar) + 0.02,
                                  0.095 * std::sin(polar) * std::sin(azimuth) + 0.01 * std::cos(polar));
      if (i == rings) continue;
      const std::uint32_t a = i * sectors + k, b = i * sectors + (k + 1) % sectors;
      mesh.triangles.push_back({a, b, a + sectors});
      mesh.triangles.push_back({b, b + sectors, a + sectors});
    }
  compute_normals(mesh);
  return mesh;
}

Groom standing_on(const Mesh& mesh, std::span<const Root> roots) {
  Groom groom;
  for (const Root& root : roots) {
    const auto& t = mesh.triangles[root.triangle];
    glm::vec3 place(0);
    for (int k = 0; k < 3; ++k) place += mesh.positions[t[std::size_t(k)]] * root.weights[k];
    for (int i = 0; i < 4; ++i) groom.positions.push_back(place + 0.01f * float(i) * glm::vec3(0.2f, 1, -0.3f));
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.vertex_count(), 3e-5f);
  return groom;
}

TEST(NearestOnTriangle, AnyPoint_IsNearerThanEverySampleOfTheTriangle) {
  RandomStream random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const glm::dvec3 a = random_point(random), b = random_point(random), c = random_point(random),
                     p = random_point(random, 2);
    const MeshPoint found = nearest_on_triangle(a, b, c, p);
    EXPECT_NEAR(found.weights.x + found.weights.y + found.weights.z, 1, 1e-12);
    EXPECT_GE(std::min({found.weights.x, found.weights.y, found.weights.z}), 0);
    double sampled = 1e9;
    for (int i = 0; i <= 40; ++i)
      for (int k = 0; k <= 40 - i; ++k)
        sampled = std::min(sampled, glm::distance(p, (a * double(40 - i - k) + b * double(i) + c * double(k)) / 40.0));
    EXPECT_LE(found.distance, sampled + 1e-12);
    EXPECT_GT(found.distance, sampled - 0.1);
  }
}

TEST(NearestOnTriangle, WithoutArea_IsTheNearestPointOfItsEdges) {
  const MeshPoint on_line = nearest_on_triangle({0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1.5, 1, 0});
  EXPECT_NEAR(on_line.distance, 1, 1e-12);
  const MeshPoint at_point = nearest_on_triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 3});
  EXPECT_NEAR(at_point.distance, 2, 1e-12);
}

TEST(NearestTriangle, InATree_IsTheNearestOfAllTriangles) {
  const Mesh mesh = soup(500);
  const NearestTriangle tree(mesh);
  RandomStream random(9);
  for (int trial = 0; trial < 300; ++trial) {
    const glm::dvec3 p = random_point(random, 1.5);
    double least = 1e9;
    for (const auto& t : mesh.triangles)
      least = std::min(least, nearest_on_triangle(glm::dvec3(mesh.positions[t[0]]), glm::dvec3(mesh.positions[t[1]]),
                                                  glm::dvec3(mesh.positions[t[2]]), p)
                                  .distance);
    EXPECT_DOUBLE_EQ(tree.at(p).distance, least);
  }
}

TEST(Binding, RootsOnTheMesh_AreFoundAgain) {
  const Mesh mesh = egg();
  const auto roots = scatter_roots(mesh, 300, 3);
  const Groom groom = standing_on(mesh, roots);
  const auto binding = bind_roots(groom, mesh, 1e-3);
  ASSERT_TRUE(binding);
  EXPECT_LT(binding->report.distance.greatest, 1.5e-8);
  EXPECT_EQ(binding->report.far_strands, 0u);
}

TEST(Binding, FarEmptyAndDegenerate_AreCounted) {
  Mesh mesh = egg();
  mesh.triangles.push_back({0, 0, 1});
  Groom groom = standing_on(mesh, scatter_roots(egg(), 10, 3));
  for (std::size_t v = 0; v < 8; ++v) groom.positions[v] += glm::vec3(0, 1, 0);
  groom.offsets.push_back(groom.offsets.back());
  const auto binding = bind_roots(groom, mesh, 0.01);
  ASSERT_TRUE(binding);
  EXPECT_EQ(binding->report.far_strands, 2u);
  EXPECT_EQ(binding->report.empty_strands, 1u);
  EXPECT_EQ(binding->report.degenerate_triangles, 1u);
  ASSERT_EQ(binding->roots.size(), 11u);
  move_roots_onto(groom, mesh, binding->roots);
  EXPECT_LT(bind_roots(groom, mesh, 0.01)->report.distance.greatest, 1e-7);
}

TEST(Binding, MeshWithoutArea_IsRefused) {
  Mesh mesh;
  mesh.positions.assign(3, glm::vec3(0));
  mesh.triangles = {{0, 1, 2}};
  EXPECT_FALSE(bind_roots({}, mesh, 1).ok());
}

TEST(Carry, RestingMesh_LeavesStrandsWhereTheyWere) {
  const Mesh mesh = egg();
  const auto roots = scatter_roots(mesh, 300, 3);
  const Groom groom = standing_on(mesh, roots);
  std::vector<glm::vec3> places(groom.vertex_count());
  carry(rest_on_mesh(groom, mesh, roots), mesh, places);
  for (std::size_t v = 0; v < places.size(); ++v) EXPECT_LT(glm::distance(places[v], groom.positions[v]), 1e-7f);
}

TEST(Carry, RigidMotion_TurnsStrandsWithTheMesh) {
  const Mesh mesh = egg();
  const auto roots = scatter_roots(mesh, 300, 3);
  const Groom groom = standing_on(mesh, roots);
  const glm::dmat4 motion =
      glm::rotate(glm::translate(glm::dmat4(1), {0.3, -0.1, 0.2}), 2.0, glm::normalize(glm::dvec3(1, 1, -2)));
  std::vector<glm::vec3> places(groom.vertex_count());
  carry(rest_on_mesh(groom, mesh, roots), transformed(mesh, motion), places);
  for (std::size_t v = 0; v < places.size(); ++v)
    EXPECT_LT(glm::distance(glm::dvec3(places[v]), glm::dvec3(motion * glm::dvec4(groom.positions[v], 1))), 4e-7);
}

TEST(Carry, BentMesh_StrandsBeginOnItAndKeepTheirLengths) {
  const Mesh mesh = egg();
  const auto roots = scatter_roots(mesh, 300, 3);
  const Groom groom = standing_on(mesh, roots);
  Mesh bent = mesh;
  for (glm::vec3& p : bent.positions) p += glm::vec3(0.5f * p.y * p.y, 0.1f * p.x, 3 * p.x * p.z);
  compute_normals(bent);
  Groom moved = groom;
  carry(rest_on_mesh(groom, mesh, roots), bent, moved.positions);
  EXPECT_LT(bind_roots(moved, bent, 1)->report.distance.greatest, 1e-6 * 0.25);
  for (std::size_t s = 0; s < 300; ++s) EXPECT_NEAR(strand_length(moved, s), strand_length(groom, s), 1e-7);
}

/// As where a joint folds a large triangle of a character: only the places of its corners turn.
TEST(Carry, TriangleThatFoldsBesideItsNormals_KeepsHairOverIt) {
  Mesh mesh{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {}, {}, {{0, 1, 2}}};
  compute_normals(mesh);
  const std::vector<Root> roots{{0, glm::vec3(1 / 3.0f)}};
  Groom groom;
  for (int i = 0; i < 4; ++i) groom.positions.emplace_back(1 / 3.0f, 0.01f * float(i), 1 / 3.0f);
  groom.offsets = {0, 4};
  const RestOnMesh rest = rest_on_mesh(groom, mesh, roots);
  std::vector<glm::vec3> carried(4);
  for (double angle = 0; angle < 3; angle += 0.1) {
    Mesh folded = transformed(mesh, glm::rotate(glm::dmat4(1), angle, {1, 0, 0}));
    const glm::vec3 facet = folded.normals[0];
    folded.normals = mesh.normals;
    carry(rest, folded, carried);
    EXPECT_GT(glm::dot(carried[3] - carried[0], facet), 0.03f * std::cos(0.1746f)) << angle;
  }
}

TEST(Placement, RootsOfAnotherScaleAndPlace_AreBroughtOntoTheMesh) {
  const Mesh mesh = egg();
  const auto on_cap = scatter_roots(egg(0.55), 500, 3);
  Groom groom = standing_on(egg(0.55), on_cap);
  place(groom, {.scale = 110, .shift = {3, -20, 5}});
  std::vector<glm::vec3> points;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) points.push_back(groom.strand(s)[0]);
  const auto found = fit_placement(points, mesh, 0.01);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->scale * 110, 1, 0.02);
  EXPECT_LT(found->mean_distance, 5e-4);
}

}  // namespace
}  // namespace cuticle::strands::binding_test
