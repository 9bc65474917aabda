// Scenes of several files: own keys win, places of errors are those in the file that has them.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/scene.h"

namespace cuticle::scene::include_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A folder of this test's own, with a folder `more` in it.
class Include : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cuticle_include_" + std::to_string(::getpid()) + "_" +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_ / "more");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, std::string_view text) { std::ofstream(folder_ / name) << text; }
  Result<Scene> scene(std::string_view text) {
    write("scene.json", text);
    return load_scene((folder_ / "scene.json").string(), {});
  }
  void expect_refused(std::string_view text, std::initializer_list<const char*> words) {
    const auto loaded = scene(text);
    ASSERT_FALSE(loaded) << text;
    for (const char* word : words) EXPECT_THAT(loaded.error().message, HasSubstr(word));
  }
  fs::path folder_;
};

TEST_F(Include, OwnKeysWinDownThroughObjects) {
  write("base.json", R"({"strand_count": 7, "name": "base", "camera": {"fov_deg": 30, "resolution_px": [10, 20]}})");
  const auto loaded =
      scene(R"({"schema_version": 1, "$include": "base.json", "name": "own", "camera": {"resolution_px": [4, 5]}})");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->name, "own");
  EXPECT_EQ(loaded->strand_count, 7);
  EXPECT_EQ(loaded->camera.camera.resolution, glm::ivec2(4, 5));
  EXPECT_NEAR(loaded->camera.camera.vertical_field_of_view, 0.5236, 1e-4);
}

TEST_F(Include, FilesInFiles_EarlierOnesWin) {
  write("more/deep.json", R"({"strand_count": 1, "strand_vertices": 3})");
  write("more/a.json", R"({"$include": "deep.json", "strand_count": 2})");
  write("b.json", R"({"strand_vertices": 9, "frames_per_second": 50})");
  const auto loaded = scene(R"({"schema_version": 1, "$include": ["more/a.json", "b.json"]})");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->strand_count, 2);
  EXPECT_EQ(loaded->strand_vertices, 3);
  EXPECT_EQ(loaded->frames_per_second, 50);
}

TEST_F(Include, PartOfAScene_IsTakenWhereItStands) {
  write("more/camera.json", R"({"fov_deg": 30})");
  const auto loaded = scene(R"({"schema_version": 1, "camera": {"$include": "more/camera.json", "near_m": 0.5}})");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->camera.camera.near_plane, 0.5);
}

TEST_F(Include, NamesInAnIncludedFile_AreRelativeToIt) {
  write("more/hair.data", "");
  write("more/groom.json", R"({"file": "hair.data"})");
  const auto loaded = scene(R"({"schema_version": 1, "groom": {"$include": "more/groom.json"}})");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(fs::path(loaded->groom.file), folder_ / "more/hair.data");
}

TEST_F(Include, Errors_NameTheirOwnFileLineAndColumn) {
  write("base.json", "{\n  \"strand_count\": 3,\n  \"camera\": {\"fov_deg\": 999}\n}");
  expect_refused(R"({"schema_version": 1, "$include": "base.json"})", {"base.json:3:14: camera.fov_deg", "999"});
  expect_refused("{\"schema_version\": 1,\n \"$include\": \"none.json\"}", {"scene.json:2:2: $include", "none.json"});
  expect_refused(R"({"schema_version": 1, "$include": 5})", {"expected the name of a file"});
  write("list.json", "[1]");
  expect_refused(R"({"schema_version": 1, "$include": "list.json"})", {"list.json", "expected an object"});
  write("broken.json", "{\n,}");
  expect_refused(R"({"schema_version": 1, "$include": "broken.json"})", {"broken.json", "line 2"});
}

TEST_F(Include, FileThatIncludesItself_IsRefused) {
  expect_refused(R"({"schema_version": 1, "$include": "scene.json"})", {"16th file within another"});
}

TEST_F(Include, FilesThatMultiply_AreRefused) {
  write("a.json", R"({"$include": ["b.json", "b.json", "b.json", "b.json", "b.json", "b.json", "b.json"]})");
  write("b.json", R"({"$include": ["c.json", "c.json", "c.json", "c.json", "c.json", "c.json", "c.json"]})");
  write("c.json", R"({"$include": ["d.json", "d.json", "d.json", "d.json", "d.json", "d.json", "d.json"]})");
  write("d.json", "{}");
  expect_refused(R"({"schema_version": 1, "$include": "a.json"})", {"c.json:1:2", "256 files"});
}

TEST_F(Include, ObjectOfTooManyKeys_IsRefused) {
  std::string many = R"({"camera": {"fov_deg": 30)";
  for (int k = 0; k < 10000; ++k) many += ", \"k" + std::to_string(k) + "\": 0";
  write("many.json", many + "}}");
  expect_refused(R"({"schema_version": 1, "$include": "many.json", "camera": {"fov_deg": 20}})",
                 {"many.json", "10001 keys"});
}

TEST_F(Include, NewerVersion_IsRefusedWithWhatToDo) {
  expect_refused(R"({"schema_version": 2})", {"schema_version = 2", "newer"});
}

}  // namespace
}  // namespace cuticle::scene::include_test
