// Every format of the registry: round trips that keep what the format says it holds, damage refused or mended; then
// what single formats must understand of files that other programs write.
#include <cstring>
#include <limits>

#include "core/file.h"
#include "strands/formats/bytes.h"
#include "strands/formats/curve_basis.h"
#include "strands/formats/formats.h"
#include "strands/formats/tfx/bones.h"
#include "strands/refusals.h"
#include "tests/support/synthetic_grooms.h"
#include "tests/support/temporary_folder.h"

namespace cuticle::strands::strand_formats_test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Two strands with everything that a groom can have.
Groom rich_groom(bool same_size) {
  Groom groom;
  tests::add_strand(groom, {{0.1f, 1, 2}, {3, 4, 5}, {6, 7, 8.5f}}, 0.25f);
  if (same_size)
    tests::add_strand(groom, {{-1, 0, 0.1f}, {0, 1e-7f, 0}, {1, 1, 1}}, 0.25f);
  else
    tests::add_strand(groom, {{-1, 0, 0.1f}, {1, 1e20f, 1}}, 0.25f);
  const std::size_t count = groom.vertex_count();
  for (std::size_t v = 0; v < count; ++v) groom.radii[v] = 0.1f * float(v + 1) * float(v + 1);
  groom.root_uv = {{0.1f, 0.2f}, {1, 0}};
  groom.root_triangle = {7, 4000000000u};
  groom.root_barycentrics = {{0.3f, 0.3f}, {0, 1.0f / 3}};
  std::vector<float> numbers(3 * count);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = 0.07f * float(i);
  groom.attributes["color"] = {Attribute::Domain::vertex, 3, numbers};
  groom.attributes["tension"] = {
      Attribute::Domain::vertex, 1, {numbers.begin(), numbers.begin() + std::ptrdiff_t(count)}};
  groom.attributes["group_id"] = {Attribute::Domain::strand, 1, {3, 5}};
  groom.attributes["bone_weight"] = {Attribute::Domain::strand, 4, {0, 1, 0, 0, 0.1f, 0.2f, 0.3f, 0.4f}};
  groom.attributes["frame"] = {Attribute::Domain::strand, 6, {numbers.begin(), numbers.begin() + 12}};
  return groom;
}

Result<ParsedGroom> parse(std::string_view name, std::span<const std::byte> bytes, Damage damage = Damage::refuse) {
  return format_of("x." + std::string(name)).value()->parse(bytes, "x", damage);
}
ParsedGroom parsed(std::string_view name, std::string_view text, Damage damage = Damage::refuse) {
  auto result = parse(name, to_bytes(text), damage);
  EXPECT_TRUE(result.ok()) << result.error().message;
  return result ? std::move(*result) : ParsedGroom{};
}
std::string refusal(std::string_view name, std::string_view text) {
  const auto result = parse(name, to_bytes(text));
  EXPECT_FALSE(result.ok());
  return result ? "" : result.error().message;
}

class EveryFormat : public testing::TestWithParam<const Format*> {
 protected:
  /// What the format holds of the rich groom, and the file with it.
  void SetUp() override {
    groom_ = rich_groom(!GetParam()->holds.differing_sizes);
    lost_ = drop_what_it_cannot_hold(groom_, *GetParam());
    bytes_ = GetParam()->format(groom_, 1).value();
  }
  Groom groom_;
  std::vector<std::string> lost_;
  std::vector<std::byte> bytes_;
};

std::vector<const Format*> written_formats() {
  std::vector<const Format*> result;
  for (const Format* format : formats())
    if (format->format) result.push_back(format);
  return result;
}
INSTANTIATE_TEST_SUITE_P(All, EveryFormat, testing::ValuesIn(written_formats()),
                         [](const auto& info) { return std::string(info.param->name); });

TEST_P(EveryFormat, WrittenAndRead_KeepsWhatItHolds) {
  const auto again = GetParam()->parse(bytes_, "again", Damage::refuse);
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(again->groom.offsets, groom_.offsets);
  EXPECT_EQ(again->groom.positions, groom_.positions);
  EXPECT_EQ(again->groom.root_uv, groom_.root_uv);
  EXPECT_EQ(again->groom.root_triangle, groom_.root_triangle);
  EXPECT_EQ(again->groom.root_barycentrics, groom_.root_barycentrics);
  EXPECT_EQ(again->groom.attributes, groom_.attributes);
  const Widths widths = GetParam()->holds.widths;
  if (widths == Widths::vertices) {
    EXPECT_EQ(again->groom.radii, groom_.radii);
  }
  if (widths == Widths::ends) {
    EXPECT_EQ(again->groom.radii.back(), groom_.radii.back());
  }
}

TEST_P(EveryFormat, WhatItCannotHold_IsSaid) {
  const Holds& holds = GetParam()->holds;
  const auto said = [this](const char* what) { return testing::Value(lost_, Contains(HasSubstr(what))); };
  EXPECT_EQ(said("root texture coordinates"), !holds.root_uv);
  EXPECT_EQ(said("triangles"), !holds.roots);
  EXPECT_EQ(said("hold radii"), holds.widths == Widths::none);
  EXPECT_EQ(said("between the ends"), holds.widths == Widths::ends);
  for (const auto& [name, attribute] : rich_groom(true).attributes)
    EXPECT_EQ(said(("'" + name + "'").c_str()), !groom_.attributes.contains(name)) << name;
}

TEST_P(EveryFormat, CutAnywhere_IsRefusedOrAValidGroom) {
  for (std::size_t size = 0; size < bytes_.size(); ++size) {
    const auto cut = GetParam()->parse(std::span(bytes_).first(size), "cut", Damage::refuse);
    ASSERT_TRUE(!cut.ok() || validate(cut->groom).ok()) << size;
  }
}

TEST_P(EveryFormat, PointNotFinite_IsRefusedAndCanBeMended) {
  groom_.positions[1].y = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::byte> bytes = GetParam()->format(groom_, 1).value();
  EXPECT_FALSE(GetParam()->parse(bytes, "damaged", Damage::refuse).ok());
  auto damaged = GetParam()->parse(bytes, "damaged", Damage::keep);
  ASSERT_TRUE(damaged.ok()) << damaged.error().message;
  EXPECT_EQ(repair(damaged->groom).points_not_finite, 1u);
  EXPECT_TRUE(validate(damaged->groom).ok());
  EXPECT_EQ(damaged->groom.offsets, groom_.offsets);
}

TEST(Repair, EachKindOfDamage_IsCountedAndLengthsStay) {
  Groom groom;
  tests::add_strand(groom, {{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 4}}, 1);
  tests::add_strand(groom, {{5, 5, 5}, {5, 5, 5}}, 1);
  tests::add_strand(groom, {{1, 1, 1}}, 1);
  tests::add_strand(groom, {{0, 0, 0}, {NAN, 0, 0}, {2, 0, 0}}, 1);
  groom.radii[0] = -1;
  groom.root_uv = {{1, 1}, {2, 2}, {3, 3}, {4, INFINITY}};
  groom.attributes["heat"] = {Attribute::Domain::vertex, 1, {0, 1, 9, 3, 0, 0, 0, 4, 0, 6}};
  const Repairs repairs = repair(groom);
  EXPECT_EQ(repairs, (Repairs{1, 2, 1, 1, 2, 2}));
  EXPECT_TRUE(validate(groom).ok());
  EXPECT_THAT(groom.offsets, ElementsAre(0u, 4u, 7u));
  EXPECT_EQ(strand_length(groom, 0), 5);
  EXPECT_EQ(strand_length(groom, 1), 2);
  EXPECT_EQ(groom.positions[2], glm::vec3(0, 1, 2));  // the middle of the longest segment
  EXPECT_THAT(groom.attributes["heat"].values, ElementsAre(0, 1, 2, 3, 4, 5, 6));
  EXPECT_THAT(groom.root_uv, ElementsAre(glm::vec2(1, 1), glm::vec2(4, 0)));
  EXPECT_THAT(sentences(repairs), Contains(HasSubstr("1 strands without length")));
}

TEST(Repair, ValuesNearTheLargestFloat_StayFinite) {
  Groom groom;
  tests::add_strand(groom, {{0, 0, 0}, {NAN, 0, 0}, {2, 0, 0}}, 1);
  groom.attributes["heat"] = {Attribute::Domain::vertex, 1, {-3e38f, 0, 3e38f}};
  repair(groom);
  EXPECT_THAT(groom.attributes["heat"].values, ElementsAre(-3e38f, 0, 3e38f));
}

TEST(Repair, SoundGroom_IsNotTouched) {
  Groom groom = rich_groom(false);
  EXPECT_EQ(repair(groom), Repairs{});
  EXPECT_EQ(groom, rich_groom(false));
}

TEST(CurveBasis, Joints_LieOnTheCurve) {
  using Kind = CurveBasis::Kind;
  const std::vector<float> line{0, 1, 2, 3, 4, 5, 6};  // of equal steps, every basis gives the parameter itself
  EXPECT_THAT(joints<float>({Kind::bezier, 3}, line), ElementsAre(0, 3, 6));
  EXPECT_THAT(joints<float>({Kind::bezier, 2}, line), ElementsAre(0, 2, 4, 6));
  EXPECT_THAT(joints<float>({Kind::catmull_rom}, line), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(joints<float>({Kind::b_spline, 2}, line), ElementsAre(0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f));
  const std::vector<float> bent{0, 0, 6, 0, 0};
  EXPECT_THAT(joints<float>({Kind::b_spline, 3}, bent), ElementsAre(1, 4, 1));
  EXPECT_THAT(joints<float>({Kind::b_spline, 3, true}, bent), ElementsAre(0, 1, 4, 1, 0));
}

TEST(PbrtFile, PiecesOneAfterTheOther_AreOneStrand) {
  const ParsedGroom file = parsed("pbrt", R"(WorldBegin
Shape "curve" "string type" [ "cylinder" ] "point P" [ 0 0 0  1 0 0  2 0 0  3 0 0 ] "float width0" [ 0.4 ] "float width1" [ 0.2 ]
Shape "curve" "point P" [ 3 0 0  4 1 0  5 1 0  6 0 0 ] "float width0" 0.2 "float width1" 0.1 # the same strand
Shape "curve" "point3 P" [ 9 0 0  9 1 0  9 2 0  9 3 0 ] "float width" 0.5
Translate 1 0 0
Shape "curve" "point3 P" [ 9 3 0  9 4 0  9 5 0  9 6 0 ] "float width" 0.5)");
  EXPECT_THAT(file.groom.offsets, ElementsAre(0u, 3u, 5u, 7u));
  EXPECT_THAT(file.groom.radii, ElementsAre(0.2f, 0.1f, 0.05f, 0.25f, 0.25f, 0.25f, 0.25f));
  EXPECT_THAT(file.notes, AllOf(Contains(HasSubstr("transformations")), Contains(HasSubstr("bend by up to 0.75"))));
}

TEST(PbrtFile, BadText_IsRefusedByLine) {
  EXPECT_THAT(refusal("pbrt", "\nShape \"curve\" \"point3 P\" [ 0 0 x ]"), HasSubstr("line 2: P 'x'"));
  EXPECT_THAT(refusal("pbrt", "Shape \"curve\" \"point3 P\" [ 0 0 0 1 1 1 ]"), HasSubstr("P has 6 numbers"));
  EXPECT_THAT(refusal("pbrt", "Shape \"sphere\""), HasSubstr("no Shape \"curve\""));
}

TEST(PbrtFile, Written_IsACurveThroughThePoints) {
  Groom groom;
  tests::add_strand(groom, {{0, 0, 0}, {3, 0, 0}, {6, 3, 0}}, 0.5f);
  const auto bytes = (*format_of("x.pbrt"))->format(groom, 1).value();
  EXPECT_THAT(to_text(bytes),
              HasSubstr("[ 0 0 0 1 0 0 2 -0.5 0 3 0 0 4 0.5 0 5 2 0 6 3 0 ] \"float width0\" 1 \"float width1\" 1"));
}

TEST(MitsubaFile, CurveText_IsRead) {
  const ParsedGroom file = parsed("curves", "0 0 0 0.5\r\n1 0 0 0.25\r\n\r\n\n2 0 0 1e-1\n3 0 0 .5\n4 0 0 .5");
  EXPECT_THAT(file.groom.offsets, ElementsAre(0u, 2u, 5u));
  EXPECT_THAT(file.groom.radii, ElementsAre(0.5f, 0.25f, 0.1f, 0.5f, 0.5f));
  EXPECT_THAT(refusal("curves", "0 0 0 1\n0 0 1\n"), HasSubstr("line 2"));
  EXPECT_THAT(refusal("curves", "0 0 0 1\n\n0 0 1 1\n0 1 1 1\n"), HasSubstr("line 2: curve 0 has 1 point"));
}

TEST(UsdaFile, CubicCurvesAndForeignPrims_AreUnderstood) {
  const ParsedGroom file = parsed("usda", R"(#usda 1.0
( doc = """two
lines ) with a bracket"""
  metersPerUnit = 0.01 upAxis = "Z" )
def Xform "head" { double3 xformOp:translate = (0, 1, 0)
  def Mesh "scalp" { int[] faceVertexCounts = [3] point3f[] points = [(0, 0, 0)] }
  def BasisCurves "hair" ( kind = "component" ) {
    uniform token type = "cubic" uniform token basis = "catmullRom" uniform token wrap = "pinned"
    int[] curveVertexCounts = [3, 2]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 0, 5), (0, 0, 6)] ( customData = { string a = "]" } )
    float[] widths = [0.5] ( interpolation = "constant" )
    texCoord2f[] primvars:groom_root_uv = [(0.25, 0.5), (0, 1)] ( interpolation = "uniform" )
    rel material:binding = </head/material>
    point3f[] velocities.timeSamples = { 0: [(0, 0, 0)] }
  } })");
  EXPECT_THAT(file.groom.offsets, ElementsAre(0u, 3u, 5u));
  EXPECT_EQ(file.groom.positions[4], glm::vec3(0, 0, 6));
  EXPECT_EQ(file.groom.radii[3], 0.25f);
  EXPECT_THAT(file.groom.root_uv, ElementsAre(glm::vec2(0.25f, 0.5f), glm::vec2(0, 1)));
  EXPECT_EQ(file.metres_per_unit, 0.01);
  EXPECT_THAT(file.notes, AllOf(Contains(HasSubstr("transformations")), Contains(HasSubstr("time samples")),
                                Contains(HasSubstr("axis is Z"))));
}

TEST(UsdaFile, BadText_IsRefused) {
  const std::string begin = "#usda 1.0\ndef BasisCurves \"a\" { uniform token type = \"linear\"\n";
  EXPECT_THAT(refusal("usda", "#sdf 1.4\n"), HasSubstr("line 1"));
  EXPECT_THAT(refusal("usda", begin + "int[] curveVertexCounts = [3] point3f[] points = [(0,0,0),(1,1,1)] }"),
              HasSubstr("curve 0 has 3 points of 2"));
  EXPECT_THAT(refusal("usda", begin + "point3f[] points = [(0, x, 0)] }"), HasSubstr("line 3: 'x' is no number"));
  EXPECT_THAT(refusal("usda", "#usda 1.0\n"), HasSubstr("no BasisCurves"));
}

TEST(PlyFile, Layouts_AreFoundAndReported) {
  const std::string head = "ply\nformat ascii 1.0\n", xyz = "property float x\nproperty float y\nproperty double z\n";
  const ParsedGroom edges = parsed("ply", head + "element vertex 4\n" + xyz +
                                              "element edge 2\nproperty int vertex1\nproperty int vertex2\n"
                                              "end_header\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n2 0\n1 3\n");
  EXPECT_THAT(edges.groom.positions,
              ElementsAre(glm::vec3(1, 0, 0), glm::vec3(3, 0, 0), glm::vec3(2, 0, 0), glm::vec3(0, 0, 0)));
  EXPECT_THAT(edges.notes, Contains(HasSubstr("'edge'")));
  const ParsedGroom colors =
      parsed("ply", head + "element vertex 4\n" + xyz +
                        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                        "end_header\n0 0 0 255 0 0\n1 0 0 255 0 0\n2 0 0 0 51 0\n3 0 0 0 51 0\n");
  EXPECT_THAT(colors.groom.offsets, ElementsAre(0u, 2u, 4u));
  EXPECT_EQ(colors.groom.attributes.at("color").values[7], 0.2f);
  std::string cloud = head + "element vertex 300\n" + xyz + "end_header\n";
  for (int i = 0; i < 300; ++i) cloud += std::to_string(i) + " 0 0\n";
  EXPECT_EQ(parsed("ply", cloud).groom.strand_count(), 3u);
}

TEST(PlyFile, BadFiles_AreRefused) {
  const std::string head = "ply\nformat ascii 1.0\n", xyz = "property float x\nproperty float y\nproperty float z\n";
  EXPECT_THAT(refusal("ply", "PLY\n"), HasSubstr("line 1"));
  EXPECT_THAT(refusal("ply", head + "element vertex 4000000000\n" + xyz + "end_header\n"), HasSubstr("line 3"));
  EXPECT_THAT(refusal("ply", head + "element vertex 2\n" + xyz + "end_header\n0 0 0 1 1 1"),
              HasSubstr("2 points without strands"));
  const std::string edge = "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n";
  EXPECT_THAT(refusal("ply", head + "element vertex 2\n" + xyz + edge + "0 0 0\n1 1 1\n0 1\n1 0\n"),
              HasSubstr("closed loops"));
  EXPECT_THAT(refusal("ply", head + "element vertex 2\n" + xyz + edge + "0 0 0\n1 1 1\n0 1\n0 1\n"),
              HasSubstr("branch"));
}

TEST(UscFile, RootsWithoutAStrand_AreLeftOutAndCounted) {
  std::vector<std::byte> bytes;
  for (std::uint32_t word : {2u, 1u}) append(bytes, word);
  append(bytes, glm::vec3(1, 2, 3));
  append(bytes, std::uint32_t(2));
  for (const glm::vec3& p : {glm::vec3(0), glm::vec3(0, -1, 0)}) append(bytes, p);
  const auto file = parse("data", bytes);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_THAT(file->groom.offsets, ElementsAre(0u, 2u));
  EXPECT_THAT(file->notes, ElementsAre(HasSubstr("1 of 2 roots")));
}

TEST(VtpFile, LinesAndCells_AreRead) {
  const ParsedGroom file =
      parsed("vtp", R"(<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="3" NumberOfVerts="1" NumberOfLines="1">
<CellData><DataArray type="Float32" Name="heat" format="ascii">7 8</DataArray></CellData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 2 0 0</DataArray></Points>
<Verts/><Lines><DataArray Name="connectivity" format="ascii">2 1</DataArray><DataArray Name="offsets" format="ascii">2</DataArray></Lines>
</Piece></PolyData></VTKFile>)");
  EXPECT_THAT(file.groom.positions, ElementsAre(glm::vec3(2, 0, 0), glm::vec3(1, 0, 0)));
  EXPECT_THAT(file.groom.attributes.at("heat").values, ElementsAre(8));
  EXPECT_THAT(refusal("vtp", "<VTKFile"), HasSubstr("no XML"));
}

/// Bones "neck" and "head"; strand 0 by both, strand 1 by none.
std::vector<std::byte> bones_file() {
  std::vector<std::byte> bytes;
  append(bytes, 2);
  for (const char* name : {"neck", "head"}) {
    append(bytes, 0);
    append(bytes, 5);
    for (int i = 0; i < 5; ++i) append(bytes, name[i]);
  }
  append(bytes, 2);
  for (int strand = 0; strand < 2; ++strand) {
    append(bytes, strand);
    for (int i = 0; i < 4; ++i) {
      append(bytes, i < 2 ? i : -1);
      append(bytes, strand == 0 && i < 2 ? 0.5f : 0.0f);
    }
  }
  return bytes;
}

TEST(TfxBones, File_BecomesAttributesOfTheStrands) {
  const auto weights = parse_tfxbone(bones_file(), "x.tfxbone");
  ASSERT_TRUE(weights.ok()) << weights.error().message;
  EXPECT_THAT(weights->bones, ElementsAre("neck", "head"));
  ParsedGroom groom{rich_groom(true)};
  ASSERT_TRUE(add_bones(*weights, "x.tfxbone", groom).ok());
  EXPECT_THAT(groom.groom.attributes.at("bone_index").values, ElementsAre(0, 1, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(groom.groom.attributes.at("bone_weight").values, ElementsAre(0.5f, 0.5f, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(groom.notes, AllOf(Contains(HasSubstr("neck head")), Contains(HasSubstr("1 strands have no bone"))));
}

class TfxFiles : public tests::TemporaryFolder {};

TEST_F(TfxFiles, BonesBesideTheFile_AreRead) {
  ASSERT_TRUE(write_groom(path("a.tfx"), rich_groom(true)).ok());
  ASSERT_TRUE(write_file(path("a.tfxbone"), bones_file()).ok());
  const auto file = read_groom(path("a.tfx"));
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->groom.attributes.at("bone_weight").values[1], 0.5f);
  ASSERT_TRUE(write_file(path("a.tfxbone"), {}).ok());
  EXPECT_THAT(read_groom(path("a.tfx")).error().message, HasSubstr("a.tfxbone: count of bones"));
}

TEST(TfxBones, DamagedFile_IsRefusedByOffset) {
  std::vector<std::byte> bytes = bones_file();
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(parse_tfxbone(std::span(bytes).first(size), "cut").ok()) << size;
  const std::size_t first_bone = 4 + 2 * 13 + 4 + 4;
  const int lie = 2;
  std::memcpy(bytes.data() + first_bone, &lie, 4);
  EXPECT_THAT(parse_tfxbone(bytes, "x").error().message, HasSubstr("bone at offset 38: 2, allowed -1 .. 1"));
}

TEST(Refusals, EachEngine_NamesFoundAndAllowed) {
  Groom groom = tests::coat(100, 16, 0.1, 1e-5f, 1);
  EXPECT_THAT(refusals(groom), IsEmpty());
  groom = tests::coat(10, 300, 0.1, 1e-5f, 1);
  std::string all;
  for (const Refusal& refusal : refusals(groom)) all += refusal.engine + ": " + refusal.what + "\n";
  EXPECT_THAT(all, AllOf(HasSubstr("unreal: points of a strand 300, allowed 2 .. 255"),
                         HasSubstr("unity: strands 10, allowed 64"), HasSubstr("tressfx: strands of 300 points")));
}

}  // namespace
}  // namespace cuticle::strands::strand_formats_test
