// What the library that reads glTF would take in silence, or end the program on.
#include <filesystem>
#include <fstream>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.h"
#include "strands/character/character.h"
#include "strands/character/gltf_text.h"
#include "tests/support/temporary_folder.h"

namespace cuticle::strands::hostile_gltf_test {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& text) {
  const auto character = parse_gltf(std::as_bytes(std::span(text)), "x.gltf");
  EXPECT_FALSE(character);
  return character ? "" : character.error().message;
}

TEST(HostileGltf, NestedArrays_AreRefusedBeforeTheLibraryRecurses) {
  EXPECT_THAT(refusal(R"({"asset": {"version": "2.0"}, "extras": )" + std::string(200'000, '[') +
                      std::string(200'000, ']') + "}"),
              HasSubstr("256 levels"));
}

TEST(HostileGltf, NegativeCountsAndOffsets_AreNamed) {
  for (const char* list : {"accessors", "bufferViews", "buffers"})
    for (const char* key : {"byteOffset", "byteLength"})
      for (const char* value : {"-4", "0.5", "\"4\""})
        EXPECT_THAT(
            refusal(fmt::format(R"({{"asset": {{"version": "2.0"}}, "{}": [{{"{}": {}}}]}})", list, key, value)),
            HasSubstr(fmt::format("{}[0].{}", list, key)));
}

TEST(HostileGltf, KeyGivenTwice_IsRefused) {
  EXPECT_THAT(refusal(R"({"asset": {"version": "2.0"}, "asset": {"version": "2.0"}})"), HasSubstr("twice"));
}

TEST(HostileGltf, NamesThatLeadOut_AreToldFromThoseThatStay) {
  for (const char* inside : {"a.bin", "b/a.bin", "b%20c.bin", "./a.bin", "a..b.bin"})
    EXPECT_TRUE(stays_inside(inside)) << inside;
  for (const char* outside : {"../a.bin", "/etc/passwd", "b/../../a.bin", "%2e%2e/a.bin", "..%2Fa.bin",
                              "file:///etc/passwd", "%2Fetc/passwd", "a%00.bin"})
    EXPECT_FALSE(stays_inside(outside)) << outside;
}

/// A triangle whose 36 bytes lie in another file.
std::string triangle(const std::string& uri) {
  return fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "buffers": [{{"byteLength": 36, "uri": "{}"}}], "bufferViews": [{{"buffer": 0, "byteLength": 36}}],)"
      R"( "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}}],)"
      R"( "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}], "nodes": [{{"mesh": 0}}]}})",
      uri);
}

class HostileGltfFiles : public tests::TemporaryFolder {
 protected:
  void SetUp() override {
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::filesystem::create_directories(path("model"));
    for (const char* name : {"model/near.bin", "far.bin"})
      ASSERT_TRUE(write_file(path(name), std::as_bytes(std::span(corners))));
    std::filesystem::create_symlink(path("far.bin"), path("model/link.bin"));
  }
  Result<Character> read(const std::string& uri) {
    EXPECT_TRUE(write_text_file(path("model/x.gltf"), triangle(uri)));
    return read_character(path("model/x.gltf"), {});
  }
};

TEST_F(HostileGltfFiles, BufferBesideTheFile_IsRead) {
  const auto character = read("near.bin");
  ASSERT_TRUE(character) << character.error().message;
  EXPECT_EQ(character->mesh.triangles.size(), 1u);
}

TEST_F(HostileGltfFiles, BufferOutsideTheFolder_IsRefused) {
  EXPECT_THAT(read("../far.bin").error().message, HasSubstr("outside"));
  EXPECT_FALSE(read("link.bin")) << "a link that leads out";
}

TEST_F(HostileGltfFiles, BufferInTheCurrentFolder_IsNotLookedFor) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(path(""));
  EXPECT_FALSE(read("far.bin"));
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace cuticle::strands::hostile_gltf_test
