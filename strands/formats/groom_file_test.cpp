// Whole files: units, radius, what a format cannot hold, nothing left behind after a refusal; projects of several
// files.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "strands/formats/formats.h"
#include "strands/formats/tfxproj/project.h"
#include "tests/support/synthetic_grooms.h"
#include "tests/support/temporary_folder.h"

namespace cuticle::strands::groom_file_test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class GroomFiles : public tests::TemporaryFolder {};

/// 0.2 m wide, strands of 0.3 m.
Groom groom_in_metres(float radius) {
  Groom groom;
  tests::add_strand(groom, {{-0.1f, 0, 0}, {-0.1f, -0.3f, 0}}, radius);
  tests::add_strand(groom, {{0.1f, 0, 0}, {0.1f, -0.3f, 0}}, radius);
  return groom;
}

TEST_F(GroomFiles, HairInCentimetres_ReadBackInMetres) {
  const Groom groom = groom_in_metres(4e-5f);
  ASSERT_TRUE(write_groom(path("a.hair"), groom, 0.01).ok());
  const auto file = read_groom(path("a.hair"));
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->metres_per_unit, 0.01);
  EXPECT_THAT(file->notes, Contains(HasSubstr("centimetres")));
  for (std::size_t v = 0; v < groom.vertex_count(); ++v)
    EXPECT_LT(glm::distance(file->groom.positions[v], groom.positions[v]), 1e-7f);
  EXPECT_NEAR(double(file->groom.radii[0]), 4e-5, 1e-10);
}

TEST_F(GroomFiles, GivenUnits_AreNotGuessed) {
  ASSERT_TRUE(write_groom(path("a.hair"), groom_in_metres(4e-5f)).ok());
  const auto file = read_groom(path("a.hair"), {.metres_per_unit = 2, .radius = 5e-5});
  ASSERT_TRUE(file.ok());
  EXPECT_NEAR(strand_length(file->groom, 0), 0.6, 1e-6);
  EXPECT_EQ(file->groom.radii[0], 5e-5f);
  EXPECT_TRUE(file->notes.empty());
}

TEST_F(GroomFiles, ThicknessThatIsNoFibre_BecomesTheDefaultRadiusAndIsSaid) {
  ASSERT_TRUE(write_groom(path("a.hair"), groom_in_metres(0.02f)).ok());
  const auto file = read_groom(path("a.hair"), {.metres_per_unit = 1});
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(file->groom.radii[0], k_default_radius);
  EXPECT_THAT(file->notes, Contains(HasSubstr("thickness")));
}

TEST_F(GroomFiles, TfxHasNoThickness_DefaultRadius) {
  ASSERT_TRUE(write_groom(path("a.TFX"), groom_in_metres(5e-5f)).ok());
  const auto file = read_groom(path("a.TFX"));
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(file->groom.radii[0], k_default_radius);
  EXPECT_THAT(file->notes, Contains(HasSubstr("no thickness")));
}

TEST_F(GroomFiles, WhatTheFormatCannotHold_IsSaid) {
  Groom groom = groom_in_metres(4e-5f);
  groom.root_uv = {{0, 0}, {1, 1}};
  groom.attributes["tension"] = {Attribute::Domain::strand, 1, {1, 2}};
  const auto lost = write_groom(path("a.hair"), groom);
  ASSERT_TRUE(lost.ok());
  EXPECT_THAT(*lost, Contains(HasSubstr("tension")));
  EXPECT_THAT(*lost, Contains(HasSubstr("root texture coordinates")));
}

TEST_F(GroomFiles, UnknownExtension_IsRefused) {
  std::ofstream(path("a.xyz")) << "text";
  EXPECT_THAT(read_groom(path("a.xyz")).error().message,
              AllOf(HasSubstr(".hair"), HasSubstr(".tfxproj"), HasSubstr(".npy")));
  EXPECT_THAT(write_groom(path("b.xyz"), groom_in_metres(1e-5f)).error().message,
              AllOf(HasSubstr(".hair"), Not(HasSubstr(".tfxproj")), Not(HasSubstr(".npy"))));
}

TEST_F(GroomFiles, RefusedGroom_LeavesNoFile) {
  Groom groom = groom_in_metres(1e-5f);
  tests::add_strand(groom, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 1e-5f);
  EXPECT_FALSE(write_groom(path("a.tfx"), groom).ok());
  groom.positions[0].x = NAN;
  EXPECT_FALSE(write_groom(path("a.hair"), groom).ok());
  EXPECT_FALSE(write_groom(path("b.hair"), Groom{}).ok());
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(GroomFiles, ScaleThatOverflowsFloat_IsRefused) {
  Groom groom = groom_in_metres(1e-5f);
  groom.positions[0].x = 3e38f;
  ASSERT_TRUE(write_groom(path("a.hair"), groom).ok());
  EXPECT_THAT(read_groom(path("a.hair"), {.metres_per_unit = 100}).error().message, HasSubstr("positions[0]"));
}

TEST_F(GroomFiles, AbsurdOptions_AreUsageErrors) {
  for (const ReadOptions& options : {ReadOptions{-1, 0}, ReadOptions{NAN, 0}, ReadOptions{1, 1}, ReadOptions{0, -1}})
    EXPECT_EQ(read_groom(path("a.hair"), options).error().kind, ErrorKind::usage);
}

TEST_F(GroomFiles, MissingFile_IsNamed) {
  EXPECT_THAT(read_groom(path("nowhere.hair")).error().message, HasSubstr("nowhere.hair"));
}

constexpr std::string_view k_project =
    "version 3.0\n# a comment: tail.tfx\nproject_name Two parts\r\n"
    "top.tfx 4 0.4 5.0 top.tfxsim top\r\n  tail.tfx 2 0.4 5.0\nhead.sdkmesh\ncollision_sphere 0 0 0 1\n";

TEST(Project, TwoParts_NamedInOrder) {
  const auto parts = parse_project(k_project, "a.tfxproj");
  ASSERT_TRUE(parts.ok()) << parts.error().message;
  EXPECT_THAT(parts->files, ElementsAre("top.tfx", "tail.tfx"));
  ASSERT_EQ(parts->follow_hairs.size(), parts->files.size());
  EXPECT_EQ(parts->follow_hairs[0].per_guide, 4u);
}

struct Refused {
  const char* text;
  const char* why;
};
class RefusedProject : public testing::TestWithParam<Refused> {};
INSTANTIATE_TEST_SUITE_P(
    All, RefusedProject,
    testing::Values(Refused{"top.tfx\n", "no line 'version'"}, Refused{"version x\ntop.tfx\n", "line 1: version 'x'"},
                    Refused{"version 9\ntop.tfx\n", "allowed 1 <= version < 5"},
                    Refused{"version 3\n", "names no .tfx"},
                    Refused{"version 3\n../top.tfx\n", "line 2: part '../top.tfx' lies outside"},
                    Refused{"version 3\n/etc/top.tfx\n", "outside"},
                    Refused{"version 3\na.tfx 900 0.4 5\n", "line 2: follow hairs '900', allowed 0 .. 255"},
                    Refused{"version 3\na.tfx 4 0.4 x\n", "tip separation 'x'"},
                    Refused{"version 3\na.tfx\na.tfx\n", "line 3: part 'a.tfx' is named twice"}));

TEST_P(RefusedProject, BadText_NamesFileLineAndReason) {
  const auto parts = parse_project(GetParam().text, "a.tfxproj");
  ASSERT_FALSE(parts.ok());
  EXPECT_THAT(parts.error().message, HasSubstr("a.tfxproj"));
  EXPECT_THAT(parts.error().message, HasSubstr(GetParam().why));
}

class ProjectFiles : public tests::TemporaryFolder {
 protected:
  void SetUp() override {
    write("top.tfx", {{0, 0, 0}, {0, -0.2f, 0}});
    write("tail.tfx", {{0.2f, 0, 0}, {0.2f, -0.1f, 0}, {0.2f, -0.3f, 0}});
    std::ofstream(path("a.tfxproj")) << k_project;
  }
  void write(const char* name, std::initializer_list<glm::vec3> strand) const {
    Groom groom;
    tests::add_strand(groom, strand, 5e-5f);
    ASSERT_TRUE(write_groom(path(name), groom).ok());
  }
};

TEST_F(ProjectFiles, ReadGroom_JoinsThePartsOfAnyStrandSize) {
  const auto file = read_groom(path("a.tfxproj"), {.metres_per_unit = 1});
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_THAT(file->groom.offsets, ElementsAre(0u, 2u, 5u));
  EXPECT_EQ(file->groom.positions.back(), glm::vec3(0.2f, -0.3f, 0));
  EXPECT_THAT(file->notes, Contains("tail.tfx: 1 strands"));
  EXPECT_THAT(file->notes, Contains(HasSubstr("6 follow hairs")));
  ASSERT_EQ(file->follow_hairs.size(), 2u);
  EXPECT_EQ(file->follow_hairs[1].first, 1u);
  EXPECT_EQ(file->follow_hairs[1].guides, 1u);
  EXPECT_EQ(file->follow_hairs[1].per_guide, 2u);
  EXPECT_DOUBLE_EQ(file->follow_hairs[1].reach, 0.4);
  EXPECT_DOUBLE_EQ(file->follow_hairs[1].tip_separation, 5);
}

TEST_F(ProjectFiles, MissingPart_IsNamed) {
  fs::remove(path("tail.tfx"));
  EXPECT_THAT(read_groom(path("a.tfxproj")).error().message, HasSubstr("tail.tfx"));
}

TEST_F(ProjectFiles, RootUvOfOnePartOnly_IsDropped) {
  Groom groom;
  tests::add_strand(groom, {{0, 0, 0}, {0, -0.2f, 0}}, 5e-5f);
  groom.root_uv = {{0.5f, 0.5f}};
  ASSERT_TRUE(write_groom(path("top.tfx"), groom).ok());
  const auto file = read_groom(path("a.tfxproj"), {.metres_per_unit = 1});
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_TRUE(file->groom.root_uv.empty());
}

TEST_F(ProjectFiles, ProjectOf_FindsTheFileThatNamesThePart) {
  EXPECT_EQ(project_of(path("tail.tfx")), path("a.tfxproj"));
  EXPECT_EQ(project_of(path("other.tfx")), "");
  std::ofstream(path("a.tfxproj")) << "not a project";
  EXPECT_EQ(project_of(path("tail.tfx")), "");
}

}  // namespace
}  // namespace cuticle::strands::groom_file_test
