// .hair: all 32 combinations of arrays, and damaged files refused by field and offset.
#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "strands/formats/formats.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::strands::hair_format_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

enum Bit : unsigned { segments = 1, points = 2, thickness = 4, transparency = 8, color = 16 };

/// A groom that needs exactly the arrays `bits`.
Groom groom_for(unsigned bits) {
  Groom groom;
  tests::add_strand(groom, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8.5f}}, 0.25f);
  tests::add_strand(groom, {{-1, 0, 0.1f}, {0, 0, 0}, {1, 1, 1}}, 0.25f);
  if (bits & segments) tests::add_strand(groom, {{9, 9, 9}, {10, 10, 10}}, 0.25f);
  const std::size_t count = groom.vertex_count();
  for (std::size_t v = 0; v < count; ++v)
    if (bits & thickness) groom.radii[v] = 0.125f * float(v);
  std::vector<float> one_each(count), three_each(3 * count);
  for (std::size_t i = 0; i < one_each.size(); ++i) one_each[i] = 0.1f * float(i);
  for (std::size_t i = 0; i < three_each.size(); ++i) three_each[i] = 0.01f * float(i);
  if (bits & transparency) groom.attributes["transparency"] = {Attribute::Domain::vertex, 1, one_each};
  if (bits & color) groom.attributes["color"] = {Attribute::Domain::vertex, 3, three_each};
  return groom;
}

template <class T>
T number_at(const Bytes& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}
template <class T>
Bytes with(Bytes bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(T));
  return bytes;
}

std::string refusal(const Bytes& bytes) {
  const auto groom = parse_hair(bytes, "some.hair");
  EXPECT_FALSE(groom.ok());
  if (groom.ok()) return "";
  EXPECT_EQ(groom.error().kind, ErrorKind::bad_input);
  return groom.error().message;
}

class HairArrays : public testing::TestWithParam<unsigned> {};

TEST_P(HairArrays, WrittenAndRead_IsTheSameGroom) {
  const Groom groom = groom_for(GetParam());
  const Bytes bytes = format_hair(groom);
  ASSERT_EQ(number_at<std::uint32_t>(bytes, 12), GetParam());
  const auto read = parse_hair(bytes, "some.hair");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(*read, groom);
}

TEST_P(HairArrays, CutAnywhere_IsRefused) {
  const Bytes bytes = format_hair(groom_for(GetParam()));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_FALSE(parse_hair(std::span(bytes).first(size), "cut.hair").ok()) << size;
}

TEST_P(HairArrays, WithoutPoints_IsRefused) {
  const Bytes bytes = format_hair(groom_for(GetParam()));
  EXPECT_THAT(refusal(with(bytes, 12, GetParam() & ~points)),
              AllOf(HasSubstr("arrays at offset 12"), HasSubstr("points")));
}

std::vector<unsigned> all_with_points() {
  std::vector<unsigned> result;
  for (unsigned bits = 0; bits < 32; ++bits)
    if (bits & points) result.push_back(bits);
  return result;
}
INSTANTIATE_TEST_SUITE_P(AllCombinations, HairArrays, testing::ValuesIn(all_with_points()));

TEST(HairFile, Thickness_IsTheDiameter) {
  const Bytes bytes = format_hair(groom_for(points));
  EXPECT_EQ(number_at<float>(bytes, 20), 0.5f);
  EXPECT_EQ(parse_hair(bytes, "some.hair")->radii.front(), 0.25f);
}

TEST(HairFile, DefaultColor_BecomesAnAttributeOfTheStrands) {
  const Bytes bytes = with(with(format_hair(groom_for(points)), 28, 0.5f), 24, 0.25f);
  const auto groom = parse_hair(bytes, "some.hair");
  ASSERT_TRUE(groom.ok());
  EXPECT_EQ(groom->attributes.at("color").domain, Attribute::Domain::strand);
  EXPECT_THAT(groom->attributes.at("color").values, testing::ElementsAre(0.5f, 1, 1, 0.5f, 1, 1));
  EXPECT_EQ(parse_hair(format_hair(*groom), "again.hair")->attributes, groom->attributes);
}

TEST(HairFile, TrailingBytes_AreIgnored) {
  Bytes bytes = format_hair(groom_for(points));
  bytes.resize(bytes.size() + 7);
  EXPECT_TRUE(parse_hair(bytes, "some.hair").ok());
}

TEST(HairFile, WrongSignature_IsRefused) {
  EXPECT_THAT(refusal(with(format_hair(groom_for(points)), 0, 'h')),
              AllOf(HasSubstr("some.hair"), HasSubstr("signature")));
}

TEST(HairFile, UnknownArrayBit_IsRefused) {
  EXPECT_THAT(refusal(with(format_hair(groom_for(points)), 12, 34u)), AllOf(HasSubstr("arrays"), HasSubstr("0x1f")));
}

TEST(HairFile, ZeroStrands_IsRefused) {
  EXPECT_THAT(refusal(with(format_hair(groom_for(points)), 4, 0u)),
              AllOf(HasSubstr("hair_count at offset 4"), HasSubstr("at least 1")));
}

TEST(HairFile, CountsThatOverflow_AreRefusedBeforeAllocating) {
  const Bytes bytes = format_hair(groom_for(points));
  for (std::uint32_t lie : {0xffffffffu, 0x80000000u, 0x55555556u, 1000000u}) {
    EXPECT_THAT(refusal(with(bytes, 4, lie)), HasSubstr("hair_count"));
    EXPECT_THAT(refusal(with(bytes, 8, lie)), HasSubstr("point_count"));
    EXPECT_THAT(refusal(with(with(bytes, 4, lie), 8, lie)), HasSubstr("hair_count"));
  }
}

TEST(HairFile, OnePointStrand_IsRefusedByIndex) {
  const Bytes bytes = format_hair(groom_for(points | segments));
  EXPECT_THAT(refusal(with(bytes, 130, std::uint16_t(0))),
              AllOf(HasSubstr("segments[1] at offset 130"), HasSubstr("strand 1 has 0 segments (1 points)")));
}

TEST(HairFile, OnePointStrandsByDefault_AreRefused) {
  EXPECT_THAT(refusal(with(format_hair(groom_for(points)), 16, 0u)), HasSubstr("d_segments at offset 16"));
}

TEST(HairFile, DefaultSegmentsNearOverflow_AreRefused) {
  EXPECT_THAT(refusal(with(format_hair(groom_for(points)), 16, 0xffffffffu)), HasSubstr("d_segments"));
}

TEST(HairFile, SegmentsThatDoNotAddUp_AreRefused) {
  const Bytes bytes = format_hair(groom_for(points | segments));
  EXPECT_THAT(refusal(with(bytes, 128, std::uint16_t(60000))), HasSubstr("point_count is 8"));
  EXPECT_THAT(refusal(with(bytes, 128, std::uint16_t(1))), HasSubstr("add up to 7"));
}

TEST(HairFile, CoordinateNotFinite_IsRefusedByOffset) {
  const Bytes bytes = format_hair(groom_for(points));
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    EXPECT_THAT(refusal(with(bytes, 128 + 4 * 7, bad)), HasSubstr("points[7] at offset 156"));
}

TEST(HairFile, NegativeThickness_IsRefused) {
  EXPECT_THAT(refusal(with(format_hair(groom_for(points)), 20, -1.0f)), HasSubstr("d_thickness"));
  const Bytes bytes = format_hair(groom_for(points | thickness));
  EXPECT_THAT(refusal(with(bytes, 128 + 72, -1.0f)), HasSubstr("thickness[0] at offset 200"));
}

TEST(HairFile, DefaultsNotFinite_AreRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(refusal(with(format_hair(groom_for(points)), 24, nan)), HasSubstr("at offset 24"));
}

}  // namespace
}  // namespace cuticle::strands::hair_format_test
