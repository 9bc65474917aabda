// Whole files: units, radius, what a format cannot hold, nothing left behind after a refusal.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cuticle/strands/formats/formats.h>
#include <cuticle/tests/support/synthetic_grooms.h>

namespace cuticle::strands {
namespace {

using testing::Contains;
using testing::HasSubstr;
namespace fs = std::filesystem;

class GroomFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("cuticle_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  fs::path folder_;
};

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
  std::ofstream(path("a.abc")) << "text";
  EXPECT_THAT(read_groom(path("a.abc")).error().message, HasSubstr(".hair, .tfx"));
  EXPECT_THAT(write_groom(path("b.abc"), groom_in_metres(1e-5f)).error().message, HasSubstr(".hair, .tfx"));
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

}  // namespace
}  // namespace cuticle::strands
