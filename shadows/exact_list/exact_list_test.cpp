#include <cmath>
#include <numeric>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "shadows/method.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::shadows::exact_list_test {

namespace {

Result<Transmittance> run(const strands::Groom& groom, std::span<const glm::vec3> points, const std::string& set,
                          double alpha = 0.4, glm::dvec3 light = {0, 1, 0}) {
  const Method& method = **find_method("exact_list");
  auto values = registry::parse_assignments(method.entry.parameters, set);
  if (!values) return values.error();
  return method.evaluate({&groom, alpha, light}, {points, {}}, *values);
}
float one(const strands::Groom& groom, glm::vec3 point, const std::string& set = "", double alpha = 0.4) {
  auto result = run(groom, std::span(&point, 1), set, alpha);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? result->values[0] : -1;
}
double mean(std::span<const float> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

}  // namespace

TEST(ExactList, HalfWayThroughASlab_HalfTheDepthCounts) {
  const strands::Groom groom = tests::random_slab(6000, 0.1, 0.05, 2e-5f, 7);
  for (const double height : {-0.001, 0.025}) {
    const double area = 4e-5 * tests::length_per_area(groom, 0.02, height);
    const auto points = tests::grid_below(height);
    auto result = run(groom, points, "accumulate=poisson,filter_texels=3");
    ASSERT_TRUE(result);
    EXPECT_NEAR(mean(result->values) / std::exp(-0.4 * area), 1, 0.01);
  }
}

// A texel takes the parts of a fibre's segments for crossings of fibres that do not know each other: the more segments
// a texel holds, the less an opaque fibre casts there.
TEST(ExactList, AFibreOfManySegments_CastsLess) {
  const auto shadow = [](int segments, double alpha) {
    strands::Groom groom;
    for (int fibre = 0; fibre < 40; ++fibre) {
      for (int i = 0; i <= segments; ++i)
        groom.positions.emplace_back(-0.05f + 0.1f * float(i) / float(segments), 0.05f,
                                     0.00253f * float(fibre) - 0.05f);
      groom.offsets.push_back(std::uint32_t(groom.positions.size()));
    }
    groom.radii.assign(groom.positions.size(), 2e-4f);
    const glm::vec3 behind(0, 0, 0);
    return 1 - double(one(groom, behind, "resolution=128,filter_radius_mm=20", alpha));
  };
  for (const double alpha : {0.01, 0.4, 1.0}) {
    const double whole = shadow(1, alpha), halves = shadow(256, alpha), fifths = shadow(640, alpha);
    std::printf("alpha %.2f: %.4f of the shadow with two segments a texel, %.4f with five\n", alpha, halves / whole,
                fifths / whole);
    EXPECT_NEAR(halves / whole, 1, 0.25 * alpha + 2e-3);
    EXPECT_LE(fifths, halves + 1e-6);
  }
}

TEST(ExactList, ThreeFibresInALine_EachPointKnowsThoseBeforeIt) {
  strands::Groom groom;
  for (const float y : {0.05f, 0.04f, 0.0f}) tests::add_strand(groom, {{-0.05f, y, 0}, {0.05f, y, 0}}, 0.005f);
  EXPECT_EQ(one(groom, {0, 0.051f, 0}), 1.0f);
  EXPECT_NEAR(one(groom, {0, 0.0499f, 0}), 0.6, 1e-4);
  EXPECT_NEAR(one(groom, {0, 0.0399f, 0}), 0.36, 1e-4);
  EXPECT_NEAR(one(groom, {0, -1, 0}), 0.216, 1e-4);
}

TEST(ExactList, DepthOffset_FibresSoFarBehindAPointCount) {
  strands::Groom groom;
  for (const float y : {0.05f, 0.04f, 0.0f}) tests::add_strand(groom, {{-0.05f, y, 0}, {0.05f, y, 0}}, 0.005f);
  EXPECT_NEAR(one(groom, {0, 0.041f, 0}, "depth_offset_mm=0.9"), 0.6, 1e-4);
  EXPECT_NEAR(one(groom, {0, 0.041f, 0}, "depth_offset_mm=1.1"), 0.36, 1e-4);
}

TEST(ExactList, EmptyGroomClearAndOpaqueFibres_StatedValues) {
  strands::Groom groom;
  EXPECT_EQ(one(groom, {0, 0, 0}), 1.0f);
  tests::add_strand(groom, {{-0.05f, 0, 0}, {0.05f, 0, 0}}, 0.005f);
  EXPECT_EQ(one(groom, {0, -1, 0}, "", 0), 1.0f);
  EXPECT_LT(one(groom, {0, -1, 0}, "", 1), 1e-4f);
}

TEST(ExactList, OneAndThreeThreads_SameBits) {
  const strands::Groom groom = tests::coat(2000, 6, 0.03, 1e-4f, 3);
  std::vector<float> values[2];
  for (int i = 0; i < 2; ++i) {
    tbb::global_control threads(tbb::global_control::max_allowed_parallelism, i == 0 ? 1 : 3);
    auto result = run(groom, groom.positions, "resolution=128", 0.4, {1, 1, 0.3});
    ASSERT_TRUE(result);
    values[i] = result->values;
  }
  EXPECT_EQ(values[0], values[1]);
}

}  // namespace cuticle::shadows::exact_list_test
