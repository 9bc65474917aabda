// OBJ meshes: fans, the four forms of a corner, negative indices; damaged files refused by line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "strands/formats/formats.h"

namespace cuticle::strands::obj_format_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string k_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string refusal(const std::string& text) {
  const auto mesh = parse_obj(text, "some.obj");
  EXPECT_FALSE(mesh.ok());
  return mesh.ok() ? "" : mesh.error().message;
}

TEST(ObjFile, Polygon_BecomesAFan) {
  const auto mesh = parse_obj(k_square + "f 1 2 3 4\n", "some.obj");
  ASSERT_TRUE(mesh.ok());
  using Corners = std::array<std::uint32_t, 3>;
  EXPECT_THAT(mesh->triangles, ElementsAre(Corners{0, 1, 2}, Corners{0, 2, 3}));
}

TEST(ObjFile, WithoutNormals_NormalsAreComputed) {
  const auto mesh = parse_obj(k_square + "f 1 2 3 4\n", "some.obj");
  for (const glm::vec3& normal : mesh->normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
  EXPECT_TRUE(mesh->uv.empty());
}

TEST(ObjFile, NormalsAndUv_AreKept) {
  const auto mesh = parse_obj(k_square + "vn 0 2 0\nvt 0.5 0.25 0\nf 1/1/1 2/1/1 3/1/1\r\n", "some.obj");
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh->normals[2], glm::vec3(0, 1, 0));
  EXPECT_EQ(mesh->uv[2], glm::vec2(0.5f, 0.25f));
}

TEST(ObjFile, NormalsWithoutUv_AreKept) {
  const auto mesh = parse_obj(k_square + "vn 1 0 0\nf 1//1 2//1 3//1\n", "some.obj");
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh->normals[0], glm::vec3(1, 0, 0));
}

TEST(ObjFile, NegativeIndices_CountFromTheEnd) {
  const auto mesh = parse_obj(k_square + "f -4 -3 -2\n", "some.obj");
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh->positions[2], glm::vec3(1, 1, 0));
}

TEST(ObjFile, VertexWithTwoNormals_IsSplit) {
  const auto mesh = parse_obj(k_square + "vn 1 0 0\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 3//1 4//1\n", "some.obj");
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh->positions.size(), 5u);
}

TEST(ObjFile, IndexOutOfRange_IsRefusedByLine) {
  for (const char* index : {"5", "0", "-5", "99999999999999999999", "x"})
    EXPECT_THAT(refusal(k_square + "f 1 2 " + index + "\n"), AllOf(HasSubstr("some.obj: line 5"), HasSubstr("1 .. 4")));
}

TEST(ObjFile, IndexIntoAListWithoutItems_SaysSo) {
  EXPECT_THAT(refusal(k_square + "f 1//1 2//1 3//1\n"), HasSubstr("index '1' of a list with no items"));
}

TEST(ObjFile, CoordinateNotFinite_IsRefusedByLine) {
  for (const char* word : {"nan", "inf", "1e99", "abc", ""})
    EXPECT_THAT(refusal("v 0 0 " + std::string(word) + "\n"), AllOf(HasSubstr("line 1"), HasSubstr("finite")));
}

TEST(ObjFile, FaceOfTwoCorners_IsRefused) { EXPECT_THAT(refusal(k_square + "f 1 2\n"), HasSubstr("2 corners")); }

TEST(ObjFile, WithoutFaces_IsRefused) { EXPECT_THAT(refusal(k_square), HasSubstr("no faces")); }

TEST(ObjFile, CornerOfFourParts_IsRefused) {
  EXPECT_THAT(refusal(k_square + "vn 1 0 0\nvt 0 0\nf 1/1/1/1 2 3\n"), HasSubstr("three parts"));
}

}  // namespace
}  // namespace cuticle::strands::obj_format_test
