// TressFX files: round trips of versions 3 and 4, and damaged files refused by field and offset.
#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "strands/formats/formats.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::strands::tfx_format_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

Groom two_strands() {
  Groom groom;
  tests::add_strand(groom, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}, 0);
  tests::add_strand(groom, {{-1, 0, 0.1f}, {0, 0, 0}, {1, 1, 1}}, 0);
  return groom;
}

Bytes file_of(const Groom& groom, int version) { return format_tfx(groom, version).value(); }

template <class T>
Bytes with(Bytes bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(T));
  return bytes;
}

std::string refusal(const Bytes& bytes) {
  const auto groom = parse_tfx(bytes, "some.tfx");
  EXPECT_FALSE(groom.ok());
  if (groom.ok()) return "";
  EXPECT_EQ(groom.error().kind, ErrorKind::bad_input);
  return groom.error().message;
}

class TfxVersion : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Versions, TfxVersion, testing::Values(3, 4));

TEST_P(TfxVersion, WrittenAndRead_IsTheSameGroom) {
  const auto read = parse_tfx(file_of(two_strands(), GetParam()), "some.tfx");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(*read, two_strands());
}

TEST_P(TfxVersion, Size_IsHeaderAndPositions) {
  EXPECT_EQ(file_of(two_strands(), GetParam()).size(), GetParam() == 3 ? 296u + 12 * 6 : 160u + 16 * 6);
}

TEST_P(TfxVersion, CutAnywhere_IsRefused) {
  const Bytes bytes = file_of(two_strands(), GetParam());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_FALSE(parse_tfx(std::span(bytes).first(size), "cut.tfx").ok()) << size;
}

TEST_P(TfxVersion, CountsThatOverflow_AreRefusedBeforeAllocating) {
  const Bytes bytes = file_of(two_strands(), GetParam());
  for (std::uint32_t lie : {0xffffffffu, 0x80000000u, 0x10000u}) {
    EXPECT_THAT(refusal(with(bytes, 4, lie)), HasSubstr("strand count at offset 4"));
    EXPECT_THAT(refusal(with(bytes, 8, lie)), HasSubstr("points per strand at offset 8"));
    EXPECT_THAT(refusal(with(with(bytes, 4, lie), 8, lie)), HasSubstr("points per strand"));
  }
}

TEST_P(TfxVersion, ZeroStrands_IsRefused) {
  EXPECT_THAT(refusal(with(file_of(two_strands(), GetParam()), 4, 0u)), HasSubstr("0 strands"));
}

TEST_P(TfxVersion, OnePointStrands_AreRefused) {
  EXPECT_THAT(refusal(with(file_of(two_strands(), GetParam()), 8, 1u)),
              AllOf(HasSubstr("points per strand"), HasSubstr("2 ..")));
}

TEST_P(TfxVersion, CoordinateNotFinite_IsRefusedByOffset) {
  const std::size_t offset = GetParam() == 3 ? 296 + 4 : 160 + 4;
  const Bytes bytes = with(file_of(two_strands(), GetParam()), offset, std::numeric_limits<float>::infinity());
  EXPECT_THAT(refusal(bytes), HasSubstr("positions[1] at offset " + std::to_string(offset)));
}

TEST(TfxFile, UnknownVersion_IsRefused) {
  for (float version : {0.0f, 2.9f, 5.0f, std::numeric_limits<float>::quiet_NaN()})
    EXPECT_THAT(refusal(with(file_of(two_strands(), 3), 0, version)), HasSubstr("version at offset 0"));
}

TEST(TfxFile, RootUvOfVersion4_IsKept) {
  Groom groom = two_strands();
  groom.root_uv = {{0.25f, 0.5f}, {0.75f, 1}};
  const auto read = parse_tfx(file_of(groom, 4), "some.tfx");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(*read, groom);
}

TEST(TfxFile, UnusualPinning_IsKeptAsMovability) {
  const Bytes bytes = with(file_of(two_strands(), 4), 160 + 16 + 12, 0.0f);
  const auto read = parse_tfx(bytes, "some.tfx");
  ASSERT_TRUE(read.ok());
  EXPECT_THAT(read->attributes.at("movability").values, testing::ElementsAre(0, 0, 1, 0, 1, 1));
  EXPECT_EQ(file_of(*read, 4), bytes);
}

TEST(TfxFile, OffsetsOutsideTheFile_AreRefused) {
  Groom groom = two_strands();
  groom.root_uv = {{0, 0}, {1, 1}};
  const Bytes bytes = file_of(groom, 4);
  for (std::uint32_t lie : {1u, 159u, 0xfffffff0u}) {
    EXPECT_THAT(refusal(with(bytes, 12, lie)), HasSubstr("position offset at offset 12"));
    EXPECT_THAT(refusal(with(bytes, 16, lie)), HasSubstr("uv offset at offset 16"));
  }
}

TEST(TfxFile, StrandsOfDifferentSize_CannotBeWritten) {
  Groom groom = two_strands();
  tests::add_strand(groom, {{0, 0, 0}, {1, 1, 1}}, 0);
  const auto bytes = format_tfx(groom, 4);
  ASSERT_FALSE(bytes.ok());
  EXPECT_THAT(bytes.error().message, HasSubstr("strand 2 has 2 points, strand 0 has 3"));
}

TEST(TfxFile, NoStrandsOrOddVersion_CannotBeWritten) {
  EXPECT_FALSE(format_tfx(Groom{}, 4).ok());
  EXPECT_FALSE(format_tfx(two_strands(), 5).ok());
}

}  // namespace
}  // namespace cuticle::strands::tfx_format_test
