// H15: bytes and errors of packed strands, over random and extreme input.
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "strands/packing/packing.h"
#include "tests/support/synthetic_grooms.h"
#include "strands/packing/packing.glslh"
#include <glm/geometric.hpp>

namespace cuticle::strands::packing_test {
namespace {

/// The largest error of a coordinate over the half extent of its strand, less what float itself rounds; and of radii.
struct PackedError {
  double position = 0, radius = 0, tangent = 0;
};

double half_extent(const Groom& groom, std::size_t s) {
  glm::dvec3 lower(groom.strand(s)[0]), upper = lower;
  for (const glm::vec3& p : groom.strand(s)) {
    lower = glm::min(lower, glm::dvec3(p));
    upper = glm::max(upper, glm::dvec3(p));
  }
  return 0.5 * std::max({upper.x - lower.x, upper.y - lower.y, upper.z - lower.z});
}

/// Rounding of a float of this size, and of the smallest.
double float_rounding(double value) { return std::abs(value) * 0x1p-23 + 0x1p-149; }

double position_error(const Groom& groom, const Groom& back, std::size_t s) {
  double error = 0;
  const double extent = half_extent(groom, s);
  for (std::size_t i = 0; i < groom.strand_size(s); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double given = groom.strand(s)[i][axis], got = back.strand(s)[i][axis];
      const double over = std::max(std::abs(got - given) - float_rounding(given) - float_rounding(extent), 0.0);
      error = std::max(error, extent > 0 ? over / extent : over);
    }
  return error;
}

double angle(const glm::vec3& a, const glm::vec3& b) {
  return std::atan2(glm::length(glm::cross(glm::dvec3(a), glm::dvec3(b))), glm::dot(glm::dvec3(a), glm::dvec3(b)));
}

PackedError measured(const Groom& groom) {
  const PackedGroom packed = pack(groom);
  const Groom back = unpacked(packed);
  EXPECT_TRUE(validate(back).ok());
  const auto given = tangents(groom), got = unpacked_tangents(packed);
  PackedError error;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    error.position = std::max(error.position, position_error(groom, back, s));
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) {
    error.tangent = std::max(error.tangent, angle(given[v], got[v]));
    if (groom.radii[v] > 0)
      error.radius = std::max(error.radius, std::abs(double(back.radii[v]) / double(groom.radii[v]) - 1));
  }
  return error;
}

void expect_within_bounds(const Groom& groom, const char* what) {
  const PackedError error = measured(groom);
  EXPECT_LE(error.position, k_packed_position_error) << what;
  EXPECT_LE(error.tangent, k_packed_tangent_error) << what;
}

TEST(Packing, Coat_ErrorsAndBytes) {
  const Groom groom = tests::coat(3000, 30, 0.2, 4e-5f, 9);
  const PackedError error = measured(groom);
  const double bytes = double(byte_size(pack(groom))) / double(groom.vertex_count());
  std::printf("position %.3g of the half extent, tangent %.3g rad, %.2f bytes a vertex\n", error.position,
              error.tangent, bytes);
  EXPECT_LE(error.position, k_packed_position_error);
  EXPECT_LE(error.tangent, k_packed_tangent_error);
  EXPECT_LE(error.radius, 1e-6);  // all equal: 1 in units of the largest
  EXPECT_LT(bytes, 12.81);
}

TEST(Packing, RandomStrands_StayWithinTheBounds) {
  std::mt19937_64 random(11);
  const auto number = [&] { return 2 * tests::uniform(random) - 1; };
  Groom groom;
  for (int s = 0; s < 400; ++s) {
    const double size = std::pow(10.0, 6 * number()), far = size * std::pow(10.0, 3 * number());
    const glm::dvec3 place(far * number(), far * number(), far * number());
    for (int v = 0; v < 40; ++v) {
      groom.positions.emplace_back(place + size * glm::dvec3(number(), number(), number()));
      groom.radii.push_back(float(size * tests::uniform(random)));
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  expect_within_bounds(groom, "random");
}

TEST(Packing, ExtremeStrands_StayWithinTheBounds) {
  constexpr float huge = std::numeric_limits<float>::max(), tiny = std::numeric_limits<float>::denorm_min();
  Groom groom;
  tests::add_strand(groom, {{-huge, -huge, -huge}, {huge, huge, huge}}, 1e-5f);
  tests::add_strand(groom, {{huge, 0, 0}, {huge, 0, 0}}, 0);
  tests::add_strand(groom, {{0, 0, 0}, {tiny, 0, 0}, {1e-38f, 1e-40f, 0}}, 1e-5f);
  tests::add_strand(groom, {{1, 2, 3}}, 1e-5f);
  tests::add_strand(groom, {{0, 0, 0}, {0, -1, 0}, {0, -1, 0}}, 1e-5f);
  expect_within_bounds(groom, "extreme");
}

TEST(Packing, Axes_AreExact) {
  for (const glm::vec3& axis : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0),
                                glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)}) {
    Groom groom;
    tests::add_strand(groom, {glm::vec3(0), axis}, 1);
    EXPECT_EQ(unpacked_tangents(pack(groom))[0], axis);
  }
}

TEST(Packing, EmptyGroom_IsEmpty) { EXPECT_EQ(unpacked(pack(Groom())), Groom()); }

TEST(HalfValue, KnownCodes) {
  EXPECT_EQ(half_value(0x3c00), 1.0f);
  EXPECT_EQ(half_value(0xbc00), -1.0f);
  EXPECT_EQ(half_value(0x7bff), 65504.0f);
  EXPECT_EQ(half_value(0x0001), 0x1p-24f);
  EXPECT_EQ(half_value(0x0000), 0.0f);
  EXPECT_EQ(half_value(0x3555), 0.333251953125f);
}

}  // namespace
}  // namespace cuticle::strands::packing_test
