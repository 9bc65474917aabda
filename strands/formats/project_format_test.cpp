// TressFX projects: the parts of a hairdo as one groom.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cuticle/core/file.h>
#include <cuticle/strands/formats/project.h>
#include <cuticle/tests/support/synthetic_grooms.h>

namespace cuticle::strands {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr std::string_view k_project =
    "version 3.0\n# a comment: tail.tfx\nproject_name Two parts\r\n"
    "top.tfx 4 0.4 5.0 top.tfxsim top\r\n  tail.tfx 2 0.4 5.0\nhead.sdkmesh\ncollision_sphere 0 0 0 1\n";

TEST(Project, TwoParts_NamedInOrder) {
  const auto parts = parse_project(k_project, "a.tfxproj");
  ASSERT_TRUE(parts.ok()) << parts.error().message;
  EXPECT_THAT(parts->files, ElementsAre("top.tfx", "tail.tfx"));
  EXPECT_EQ(parts->followers, 4u);
}

struct Refused {
  const char* text;
  const char* why;
};
class RefusedProject : public testing::TestWithParam<Refused> {};
INSTANTIATE_TEST_SUITE_P(All, RefusedProject,
                         testing::Values(Refused{"top.tfx\n", "no line 'version'"},
                                         Refused{"version x\ntop.tfx\n", "line 1: version 'x'"},
                                         Refused{"version 9\ntop.tfx\n", "allowed 1 <= version < 5"},
                                         Refused{"version 3\n", "names no .tfx"},
                                         Refused{"version 3\n../top.tfx\n", "line 2: part '../top.tfx' lies outside"},
                                         Refused{"version 3\n/etc/top.tfx\n", "outside"},
                                         Refused{"version 3\na.tfx\na.tfx\n", "line 3: part 'a.tfx' is named twice"}));

TEST_P(RefusedProject, BadText_NamesFileLineAndReason) {
  const auto parts = parse_project(GetParam().text, "a.tfxproj");
  ASSERT_FALSE(parts.ok());
  EXPECT_THAT(parts.error().message, HasSubstr("a.tfxproj"));
  EXPECT_THAT(parts.error().message, HasSubstr(GetParam().why));
}

class ProjectFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("cuticle_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("top.tfx", {{0, 0, 0}, {0, -0.2f, 0}});
    write("tail.tfx", {{0.2f, 0, 0}, {0.2f, -0.1f, 0}, {0.2f, -0.3f, 0}});
    std::ofstream(path("a.tfxproj")) << k_project;
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const char* name, std::initializer_list<glm::vec3> strand) const {
    Groom groom;
    tests::add_strand(groom, strand, 5e-5f);
    ASSERT_TRUE(write_groom(path(name), groom).ok());
  }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  fs::path folder_;
};

TEST_F(ProjectFiles, ReadGroom_JoinsThePartsOfAnyStrandSize) {
  const auto file = read_groom(path("a.tfxproj"), {.metres_per_unit = 1});
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_THAT(file->groom.offsets, ElementsAre(0u, 2u, 5u));
  EXPECT_EQ(file->groom.positions.back(), glm::vec3(0.2f, -0.3f, 0));
  EXPECT_THAT(file->notes, Contains("tail.tfx: 1 strands"));
  EXPECT_THAT(file->notes, Contains(HasSubstr("4 follow hairs")));
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
}  // namespace cuticle::strands
