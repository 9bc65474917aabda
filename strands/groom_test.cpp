// Grooms and meshes as data: units, tangents of odd strands, checks, figures.
#include <cmath>
#include <limits>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "strands/groom.h"
#include "strands/mesh.h"
#include "strands/refine.h"
#include "strands/statistics.h"
#include "tests/support/synthetic_grooms.h"
#include <glm/gtc/matrix_transform.hpp>

namespace cuticle::strands::groom_test {
namespace {

using testing::HasSubstr;

Groom one_strand(std::initializer_list<glm::vec3> points) {
  Groom groom;
  tests::add_strand(groom, points, 1e-5f);
  return groom;
}

/// Two strands 0.3 m long, 0.2 m apart, in units of `metres`.
Groom head_of_hair(double metres) {
  Groom groom;
  tests::add_strand(groom, {{0, 0, 0}, {0, -0.3f, 0}}, 1e-5f);
  tests::add_strand(groom, {{0.2f, 0, 0}, {0.2f, -0.3f, 0}}, 1e-5f);
  scale(groom, 1 / metres);
  return groom;
}

TEST(Units, HeadOfHairInAnyUsualUnit_GuessedBackToItsSize) {
  for (double metres : {1.0, 0.01, 0.001}) EXPECT_EQ(guess_units(head_of_hair(metres)).metres_per_unit, metres);
}

TEST(Units, InchesAndFeet_GuessedWithinTheRangeOfHeads) {
  for (double metres : {0.0254, 0.3048}) {
    const double length = 0.3 / metres * guess_units(head_of_hair(metres)).metres_per_unit;
    EXPECT_GE(length, 0.05);
    EXPECT_LE(length, 1.2);
  }
}

TEST(Units, Guess_SaysWhy) {
  EXPECT_THAT(guess_units(head_of_hair(0.01)).why, AllOf(HasSubstr("30 units"), HasSubstr("centimetres")));
}

TEST(Units, AbsurdSizeOrNoSize_StillAFinitePositiveScale) {
  for (const Groom& groom : {head_of_hair(1e-9), head_of_hair(1e9), one_strand({{1, 1, 1}, {1, 1, 1}}), Groom{}}) {
    const double metres = guess_units(groom).metres_per_unit;
    EXPECT_TRUE(std::isfinite(metres) && metres > 0) << metres;
  }
}

TEST(Tangents, StraightStrand_AreItsDirection) {
  for (const glm::vec3& t : tangents(one_strand({{0, 0, 0}, {0, 0, 1}, {0, 0, 5}}))) EXPECT_EQ(t, glm::vec3(0, 0, 1));
}

TEST(Tangents, DegenerateStrands_AreFiniteUnitVectors) {
  const float tiny = std::numeric_limits<float>::denorm_min(), huge = 1e38f;
  for (const Groom& groom : {one_strand({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}),
                             one_strand({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}), one_strand({{0, 0, 0}, {tiny, 0, 0}}),
                             one_strand({{-huge, 0, 0}, {0, huge, 0}, {huge, 0, 0}}), one_strand({{5, 5, 5}})})
    for (const glm::vec3& t : tangents(groom)) EXPECT_NEAR(double(glm::length(t)), 1, 1e-6);
}

TEST(Tangents, CoincidentNeighbours_TakeTheMeanDirection) {
  const auto result = tangents(one_strand({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 2}}));
  EXPECT_EQ(result[1], glm::vec3(0, 0, 1));
}

TEST(Groom, LengthAndBounds_OfABentStrand) {
  const Groom groom = one_strand({{0, 0, 0}, {3, 0, 0}, {3, -4, 0}});
  EXPECT_EQ(strand_length(groom, 0), 7);
  EXPECT_EQ(bounds(groom), (Bounds{{0, -4, 0}, {3, 0, 0}}));
}

TEST(Groom, BrokenStructure_IsNamed) {
  const Groom good = head_of_hair(1);
  EXPECT_TRUE(validate(good).ok());
  const auto broken = [&](auto change) {
    Groom groom = good;
    change(groom);
    const auto result = validate(groom);
    return result.ok() ? std::string("accepted") : result.error().message;
  };
  EXPECT_THAT(broken([](Groom& g) { g.offsets[1] = 0; }), HasSubstr("offsets[1]"));
  EXPECT_THAT(broken([](Groom& g) { g.offsets.back() = 99; }), HasSubstr("positions"));
  EXPECT_THAT(broken([](Groom& g) { g.radii.pop_back(); }), HasSubstr("radii"));
  EXPECT_THAT(broken([](Groom& g) { g.root_uv.resize(1); }), HasSubstr("root_uv"));
  EXPECT_THAT(broken([](Groom& g) { g.positions[3].y = NAN; }), HasSubstr("positions[3]"));
  EXPECT_THAT(broken([](Groom& g) { g.radii[2] = -1; }), HasSubstr("radii[2]"));
  EXPECT_THAT(broken([](Groom& g) { g.attributes["tension"] = {}; }), HasSubstr("tension"));
}

TEST(Statistics, DegenerateStrands_AreListed) {
  Groom groom = head_of_hair(1);
  tests::add_strand(groom, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, 1e-5f);
  tests::add_strand(groom, {{1, 1, 1}, {1, 1, 1}}, 1e-5f);
  const GroomStatistics figures = statistics(groom);
  ASSERT_EQ(figures.degenerate.size(), 2u);
  EXPECT_EQ(figures.degenerate[0].strand, 2u);
  EXPECT_TRUE(figures.degenerate[0].has_length);
  EXPECT_FALSE(figures.degenerate[1].has_length);
}

TEST(Statistics, SpacingOfARegularLattice_IsAboutItsPitch) {
  Groom groom;
  for (int i = 0; i < 96 * 96; ++i) {
    const float x = 0.01f * float(i % 96), z = 0.01f * float(i / 96);
    tests::add_strand(groom, {{x, 0, z}, {x, 0.96f, z}}, 1e-5f);
  }
  EXPECT_NEAR(statistics(groom).spacing, 0.01, 2e-3);  // cells hold whole numbers of fibres
}

TEST(Mesh, NormalsOfACube_PointOutward) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, 9, 9}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  compute_normals(mesh);
  EXPECT_LT(mesh.normals[0].x, 0);
  EXPECT_GT(mesh.normals[1].x, 0);
  EXPECT_EQ(mesh.normals[4], glm::vec3(0, 1, 0));  // of no triangle
}

TEST(Mesh, Refined_IsTheSameClosedSurfaceWithoutLongEdges) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0.3f, 0}, {0, 0, 2}};
  mesh.uv = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const Mesh fine = refined(mesh, 0.1);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  float volume = 0;
  for (const auto& t : fine.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      EXPECT_LE(glm::distance(fine.positions[from], fine.positions[to]), 0.1f);
      ++edges[{from, to}];
    }
    const auto& p = fine.positions;
    volume += glm::dot(p[t[0]], glm::cross(p[t[1]], p[t[2]])) / 6;
  }
  for (const auto& [edge, count] : edges) EXPECT_TRUE(count == 1 && edges.contains({edge.second, edge.first}));
  EXPECT_NEAR(volume, 0.1f, 1e-6f);
  EXPECT_EQ(fine.positions[3], mesh.positions[3]);
  EXPECT_EQ(fine.uv.size(), fine.positions.size());
}

TEST(Mesh, Transformed_MovesPointsAndTurnsNormals) {
  Mesh mesh{{{1, 0, 0}}, {{1, 0, 0}}, {}, {}};
  const glm::dmat4 transform = glm::rotate(glm::translate(glm::dmat4(1), {0, 5, 0}), std::acos(-1.0) / 2, {0, 0, 1});
  const Mesh moved = transformed(mesh, transform);
  EXPECT_LT(glm::distance(moved.positions[0], glm::vec3(0, 6, 0)), 1e-6f);
  EXPECT_LT(glm::distance(moved.normals[0], glm::vec3(0, 1, 0)), 1e-6f);
}

}  // namespace
}  // namespace cuticle::strands::groom_test
