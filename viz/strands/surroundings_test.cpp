// Colliders of a run as numbers and files, and hair's density.
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/file.h"
#include "sim/colliders/test_meshes.h"
#include "tests/support/temporary_folder.h"
#include "viz/strands/states.h"
#include "viz/strands/surroundings.h"

namespace cuticle::viz::surroundings_test {
namespace {

using sim::PlacedCollider;

const Placement k_place{glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3))), {0.3, -0.1, 0.2}};

std::vector<PlacedCollider> one_of_each() {
  const auto field = sim::bake_distance_field(sim::testing::ball_mesh(0.1, 12), 0.02, "ball").value();
  return {{Sphere{{0.1, 0, 0}, 0.05}, k_place},
          {make_capsule({0, 0, 0}, {0.1, 0.2, 0}, 0.03), k_place},
          {RoundedBox{.half_size = {0.1, 0.2, 0.3}}, k_place},
          {RoundedBox{.center = {0, 0.1, 0}, .half_size = {0.1, 0.02, 0.3}, .radius = 0.01}, k_place},
          {std::make_shared<const sim::DistanceField>(field), k_place}};
}

double area_of(const strands::Mesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

TEST(ColliderSurface, OfEachShape_LiesAtDistanceZeroAndIsClosed) {
  for (const PlacedCollider& collider : one_of_each()) {
    const strands::Mesh mesh = surface_of(collider);
    double volume = 0;  // from the divergence theorem: outward triangles
    for (const auto& t : mesh.triangles) {
      const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
      EXPECT_LT(std::abs(sim::distance(collider, (a + b + c) / 3.0)), 1e-3);
      volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    for (const glm::vec3& p : mesh.positions) EXPECT_LT(std::abs(sim::distance(collider, glm::dvec3(p))), 1e-6);
    EXPECT_EQ(mesh.triangles.empty(), std::holds_alternative<sim::FieldPointer>(collider.shape));
    EXPECT_TRUE(mesh.triangles.empty() || volume > 1e-4) << volume;
  }
}

TEST(ColliderSurface, Areas_AreThoseOfTheShapes) {
  const auto colliders = one_of_each();
  EXPECT_NEAR(area_of(surface_of(colliders[0])), 4 * std::numbers::pi * 0.05 * 0.05, 4e-4);
  EXPECT_NEAR(area_of(surface_of(colliders[2])), 8 * (0.1 * 0.2 + 0.2 * 0.3 + 0.1 * 0.3), 1e-6);
}

using ColliderFile = tests::TemporaryFolder;
TEST_F(ColliderFile, WhatIsWritten_ReadsBackInItsFrame) {
  const auto colliders = one_of_each();
  ColliderWriter writer;
  glm::dmat4 head(1);
  head[3] = glm::dvec4(1, 2, 3, 1);
  ASSERT_TRUE(writer.add(7, colliders, head, folder_.string()).ok());
  ASSERT_TRUE(write_text_file(path("colliders.json"), writer.text()).ok());
  const RunColliders read = read_colliders(folder_.string()).value();
  EXPECT_EQ(read.heads.at(7), head);
  const auto placed = read.at(7);
  ASSERT_EQ(placed.size(), colliders.size());
  EXPECT_TRUE(read.at(8).empty());
  for (std::size_t k = 0; k < placed.size(); ++k)
    for (const glm::dvec3 place : {glm::dvec3(0), glm::dvec3(0.3, 0, 0.25), glm::dvec3(0.35, -0.1, 0.2)})
      EXPECT_NEAR(sim::distance(placed[k], place), sim::distance(colliders[k], place), 1e-7) << k;
}

TEST_F(ColliderFile, Broken_IsRefusedByName) {
  const std::string file = path("colliders.json");
  for (const char* text : {"", "[]", R"({"colliders": [{"shape": "sphere"}], "frames": []})",
                           R"({"colliders": [{"shape": "field", "file": "none.vti"}], "frames": []})",
                           R"({"colliders": [], "frames": [{"frame": 1, "head": [1], "places": []}]})"}) {
    ASSERT_TRUE(write_text_file(file, text).ok());
    const auto read = read_colliders(folder_.string());
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_NE(read.error().message.find("colliders.json"), std::string::npos);
  }
}

TEST(HairDensity, SumsToTheLengthOfAllHair) {
  strands::Groom groom;
  groom.offsets = {0};
  for (int s = 0; s < 5; ++s) {
    for (int k = 0; k < 11; ++k) groom.positions.emplace_back(0.01F * float(s), -0.02F * float(k), 0.F);
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), 1e-5F);
  const VolumeGrid density = hair_density(groom, 0.02).value();
  EXPECT_EQ(density.values.size(),
            std::size_t(density.size.x) * std::size_t(density.size.y) * std::size_t(density.size.z));
  double length = 0;
  glm::dvec3 middle(0);
  for (int z = 0, i = 0; z < density.size.z; ++z)
    for (int y = 0; y < density.size.y; ++y)
      for (int x = 0; x < density.size.x; ++x, ++i) {
        const double mm = double(density.values[std::size_t(i)]) * 20 * 20 * 20;
        length += mm;
        middle += mm * (density.origin + 0.02 * glm::dvec3(x, y, z));
      }
  EXPECT_NEAR(length, 1000, 0.1);
  EXPECT_NEAR(middle.x / length, 0.02, 1e-3);
  EXPECT_NEAR(middle.y / length, -0.1, 1e-3);
}

TEST(ColorStrands, Contact_IsTheRunsOwnOrThatOfGivenSpheres) {
  strands::Groom groom;
  groom.offsets = {0, 2};
  groom.positions = {{0, 0, 0}, {1, 0, 0}};
  groom.radii.assign(2, 1e-5F);
  groom.attributes["contact"] = {strands::Attribute::Domain::vertex, 1, {0.002F, -0.001F}};
  const ColoredStrands own = color_strands(groom, {"contact"}).value();
  EXPECT_EQ(own.values, (std::vector<float>{2, -1}));
  const ColoredStrands both = color_strands(groom, {.name = "contact", .colliders = {{{1, 0, 0}, 0.01}}}).value();
  EXPECT_FLOAT_EQ(both.values[0], 2);
  EXPECT_FLOAT_EQ(both.values[1], -10);
  groom.attributes["guard_fired"] = {strands::Attribute::Domain::strand, 1, {1}};
  EXPECT_EQ(color_strands(groom, {"guard_fired"}).value().values, (std::vector<float>{1, 1}));
}

}  // namespace
}  // namespace cuticle::viz::surroundings_test
