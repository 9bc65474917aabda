// The real grooms and meshes of CUTICLE_TEST_DATA: counts, units, lengths as its README.md states them.
#include <cstdlib>

#include <gtest/gtest.h>

#include "strands/binding/binding.h"
#include "strands/binding/placement.h"
#include "strands/formats/formats.h"

namespace cuticle::strands::real_grooms_test {
namespace {

std::string data(const std::string& path) { return std::string(std::getenv("CUTICLE_TEST_DATA")) + "/" + path; }

struct RealGroom {
  const char* path;
  std::size_t strands, points;
  double shortest, longest;  ///< centimetres, to 0.05
};
class RealGrooms : public testing::TestWithParam<RealGroom> {};

INSTANTIATE_TEST_SUITE_P(All, RealGrooms,
                         testing::Values(RealGroom{"strands/tressfx/ponytail/front_top.tfx", 876, 16, 3.4, 39.39},
                                         RealGroom{"strands/tressfx/ponytail/side.tfx", 3066, 16, 5.96, 59.43},
                                         RealGroom{"strands/tressfx/ponytail/back.tfx", 517, 16, 4.91, 31.31},
                                         RealGroom{"strands/tressfx/ponytail/tail.tfx", 255, 16, 42.53, 92.4},
                                         RealGroom{"strands/tressfx/ponytail/tail_v3.1.tfx", 474, 16, 28.27, 92.4},
                                         RealGroom{"strands/tressfx/testhair1/TestHair1.tfx", 10027, 4, 11, 11},
                                         RealGroom{"strands/sintel/GEO-sintel_hair_emit.002-sintel_hair.tfx", 228, 32,
                                                   5.07, 28.65}));

TEST_P(RealGrooms, Read_CountsAndLengthsAsStated) {
  const auto file = read_groom(data(GetParam().path));
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->groom.strand_count(), GetParam().strands);
  EXPECT_EQ(file->groom.vertex_count(), GetParam().strands * GetParam().points);
  double shortest = 1e9, longest = 0;
  for (std::size_t s = 0; s < file->groom.strand_count(); ++s) {
    shortest = std::min(shortest, 100 * strand_length(file->groom, s));
    longest = std::max(longest, 100 * strand_length(file->groom, s));
  }
  EXPECT_NEAR(shortest, GetParam().shortest, 0.05);
  EXPECT_NEAR(longest, GetParam().longest, 0.05);
}

TEST_P(RealGrooms, Units_AreGuessedAsCentimetres) {
  const auto file = read_groom(data(GetParam().path));
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(file->metres_per_unit, 0.01) << file->notes.front();
}

// Equal positions have equal lengths.
TEST_P(RealGrooms, ThroughEveryWrittenFormat_SameCountsAndPositions) {
  const auto file = read_groom(data(GetParam().path));
  ASSERT_TRUE(file.ok()) << file.error().message;
  for (const Format* format : formats()) {
    if (!format->format) continue;
    Groom held = file->groom;
    drop_what_it_cannot_hold(held, *format);
    const auto again = format->parse(format->format(held, 1).value(), "again", Damage::refuse);
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_EQ(again->groom.positions, held.positions) << format->name;
    EXPECT_EQ(again->groom.offsets, held.offsets) << format->name;
  }
}

TEST_P(RealGrooms, BoundToAHead_KeepsCountsAndLengths) {
  const auto file = read_groom(data(GetParam().path));
  ASSERT_TRUE(file.ok()) << file.error().message;
  static const Mesh head = make_head().mesh;
  Groom bound = file->groom;
  std::vector<glm::vec3> roots;
  for (std::size_t s = 0; s < bound.strand_count(); ++s) roots.push_back(bound.strand(s)[0]);
  const auto placement = fit_placement(roots, head, 1);
  ASSERT_TRUE(placement.ok()) << placement.error().message;
  place(bound, *placement);
  const auto binding = bind_roots(bound, head, 0.005);
  ASSERT_TRUE(binding.ok()) << binding.error().message;
  move_roots_onto(bound, head, binding->roots);
  EXPECT_EQ(bound.offsets, file->groom.offsets);
  EXPECT_LT(bind_roots(bound, head, 0.005)->report.distance.greatest, 1e-7);
  for (std::size_t s = 0; s < bound.strand_count(); ++s)
    EXPECT_NEAR(strand_length(bound, s), placement->scale * strand_length(file->groom, s), 2e-6);
}

struct RealProject {
  const char* path;
  std::size_t strands;
};
class RealProjects : public testing::TestWithParam<RealProject> {};
INSTANTIATE_TEST_SUITE_P(All, RealProjects,
                         testing::Values(RealProject{"strands/tressfx/ponytail/ponytail.tfxproj",
                                                     876u + 3066 + 517 + 255},
                                         RealProject{"strands/tressfx/testhair1/TestHair1.tfxproj", 10027}));

TEST_P(RealProjects, Parts_InOneGroom) {
  const auto file = read_groom(data(GetParam().path));
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->groom.strand_count(), GetParam().strands);
  EXPECT_EQ(file->metres_per_unit, 0.01);
}

TEST(RealMeshes, LeePerrySmith_TrianglesAndNormals) {
  const auto mesh = read_obj(data("heads/lee_perry_smith/LeePerrySmith.obj"), 1);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->triangles.size(), 17684u);
  EXPECT_EQ(mesh->positions.size(), 9223u);
  EXPECT_EQ(mesh->uv.size(), mesh->positions.size());
}

TEST(RealMeshes, SintelBust_IsRead) {
  const auto mesh = read_obj(data("strands/sintel/sintel_lite_bust.obj"), 0.01);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->triangles.size(), 5952u);
  EXPECT_GE(mesh->positions.size(), 3046u);
}

}  // namespace
}  // namespace cuticle::strands::real_grooms_test
