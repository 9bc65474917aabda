#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "shadows/method.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::shadows::shadow_truth_test {

namespace {

Result<Transmittance> run(const strands::Groom& groom, const Receivers& receivers, const std::string& set,
                          double alpha = 0.4, glm::dvec3 light = {0, 1, 0}) {
  const Method& method = **find_method("truth");
  auto values = registry::parse_assignments(method.entry.parameters, set);
  if (!values) return values.error();
  return method.evaluate({&groom, alpha, light}, receivers, *values);
}
float one(const strands::Groom& groom, glm::vec3 point, const std::string& set, double alpha = 0.4) {
  auto result = run(groom, {std::span(&point, 1)}, set, alpha);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? result->values[0] : -1;
}
double mean(std::span<const float> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}
strands::Groom bar() {
  strands::Groom groom;
  tests::add_strand(groom, {{-0.05f, 0.05f, 0}, {0, 0.05f, 0}, {0.05f, 0.05f, 0}}, 0.005f);
  return groom;
}
const std::string k_point = "rays=64,footprint_radius_mm=0.001";

}  // namespace

TEST(ShadowTruth, RandomSlab_FollowsTheExponentialLaw) {
  const float radius = 2e-5f;
  const strands::Groom groom = tests::random_slab(6000, 0.1, 0.05, radius, 7);
  const std::vector<glm::vec3> points = tests::grid_below(-0.001);
  const double area = 2 * double(radius) * tests::length_per_area(groom, 0.02, -1);
  for (const double alpha : {0.2, 0.6}) {
    auto result = run(groom, {points}, "rays=36,footprint_radius_mm=0.5", alpha);
    ASSERT_TRUE(result);
    EXPECT_NEAR(mean(result->values) / std::exp(-alpha * area), 1, 0.01);
  }
}

// Rows of fibres a spacing apart cover a share f = 2 r / spacing of each layer: n layers alike give 1 - f + f (1 -
// alpha)^n in the mean, and layers across those multiply.
TEST(ShadowTruth, Lattice_IsTheProductOfItsTwoDirections) {
  const double spacing = 0.002, radius = 2.5e-4, covered = 2 * radius / spacing;
  strands::Groom groom;
  for (int layer = 0; layer < 5; ++layer)
    for (int i = -10; i < 10; ++i) {
      const float at = float(spacing * i), height = 0.01f + 0.002f * float(layer);
      if (layer < 3)
        tests::add_strand(groom, {{at, height, -0.03f}, {at, height, 0}, {at, height, 0.03f}}, float(radius));
      else
        tests::add_strand(groom, {{-0.03f, height, at}, {0, height, at}, {0.03f, height, at}}, float(radius));
    }
  const glm::vec3 points[] = {{0.001f, 0, 0.001f}, {0.0003f, 0, 0.0017f}};
  auto result = run(groom, {points}, "rays=65536,footprint_radius_mm=12");
  ASSERT_TRUE(result);
  const double expected = (1 - covered + covered * std::pow(0.6, 3)) * (1 - covered + covered * std::pow(0.6, 2));
  for (const float value : result->values) EXPECT_NEAR(double(value) / expected, 1, 0.01);
}

TEST(ShadowTruth, BentStrand_JointsCountOnce) {
  strands::Groom groom;
  tests::add_strand(groom, {{-0.05f, 0.05f, 0}, {0, 0.05f, 0}, {0, 0.05f, 0.05f}, {-0.002f, 0.055f, 0.05f}}, 0.005f);
  EXPECT_NEAR(one(groom, {0.001f, 0, -0.001f}, k_point), 0.6, 1e-6);
  EXPECT_NEAR(one(groom, {-0.003f, 0, 0.003f}, k_point), 0.6, 1e-6);
  EXPECT_NEAR(one(groom, {-0.001f, 0, 0.051f}, k_point), 0.6, 1e-6);
}

// Light from above; a second fibre covers half of the width of the one that is seen.
TEST(ShadowTruth, PointsThatAViewerMet_AreShadowedWhereTheyLie) {
  strands::Groom groom;
  tests::add_strand(groom, {{-0.05f, 0, 0}, {0, 0, 0}, {0.05f, 0, 0}}, 0.001f);
  tests::add_strand(groom, {{-0.05f, 0.01f, 0.001f}, {0, 0.01f, 0.001f}, {0.05f, 0.01f, 0.001f}}, 0.001f);
  const glm::vec3 points[] = {{0.01f, 0, 0}, {0.01f, 0, 0}}, met[] = {{0.01f, 8e-4f, 6e-4f}, {0.01f, 8e-4f, -6e-4f}};
  const std::uint32_t strand_of[] = {0, 0}, vertices[] = {1, 1};
  const Receivers receivers{
      .points = points, .strands = strand_of, .vertices = vertices, .seen_from = glm::dvec3(0, 1, 0), .met = met};
  const auto result = run(groom, receivers, "footprint_radius_mm=0", 1);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->values[0], 0.0f);
  EXPECT_EQ(result->values[1], 1.0f);
}

TEST(ShadowTruth, EmptyGroom_LetsAllThrough) { EXPECT_EQ(one({}, {0, 0, 0}, k_point), 1.0f); }
TEST(ShadowTruth, AlphaZero_LetsAllThrough) { EXPECT_EQ(one(bar(), {0, 0, 0}, k_point, 0), 1.0f); }
TEST(ShadowTruth, AlphaOne_LetsNothingThrough) { EXPECT_EQ(one(bar(), {0, 0, 0}, k_point, 1), 0.0f); }

TEST(ShadowTruth, SingleFibre_CrossingTakesAlphaAlsoAtAJoint) {
  EXPECT_NEAR(one(bar(), {0.02f, 0, 0}, k_point), 0.6, 1e-6);
  EXPECT_NEAR(one(bar(), {0, 0, 0}, k_point), 0.6, 1e-6);
  EXPECT_EQ(one(bar(), {0.02f, 0.06f, 0}, k_point), 1.0f);
}

TEST(ShadowTruth, FootprintHalfCovered_IsTheMean) {
  const strands::Groom groom = bar();
  const glm::vec3 edge(0.02f, 0, 0.005f);
  auto result = run(groom, {std::span(&edge, 1)}, "rays=16384,footprint_radius_mm=0.5");
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->values[0], 0.8, 0.005);
  EXPECT_NEAR(result->standard_error[0], 0.2 / 128, 2e-4);
}

TEST(ShadowTruth, OwnStrand_DoesNotShadowItsPoint) {
  const strands::Groom groom = bar();
  const glm::vec3 point(0.02f, 0.05f, 0);
  const std::uint32_t strand = 0;
  auto own = run(groom, {std::span(&point, 1), std::span(&strand, 1)}, k_point);
  ASSERT_TRUE(own);
  EXPECT_EQ(own->values[0], 1.0f);
}

/// Two opaque fibres along x, of 1 mm radius; the second's axis lies `away` from the first's.
strands::Groom pair_of_fibres(glm::vec3 away) {
  strands::Groom groom;
  for (const glm::vec3 axis : {glm::vec3(0), away})
    tests::add_strand(groom, {axis - glm::vec3(0.05f, 0, 0), axis, axis + glm::vec3(0.05f, 0, 0)}, 0.001f);
  return groom;
}
/// T at the middle of the first of them, under a light from +y.
float light_of_first(const strands::Groom& groom, const std::optional<glm::dvec3>& viewer) {
  const glm::vec3 point(0.01f, 0, 0);
  const std::uint32_t strand = 0;
  auto result =
      run(groom, {.points = std::span(&point, 1), .strands = std::span(&strand, 1), .seen_from = viewer}, k_point, 1);
  EXPECT_TRUE(result);
  return result ? result->values[0] : -1;
}

// Where strands pass through each other, a fibre that holds the point takes no light; one that lies before it does.
TEST(ShadowTruth, FibreThatHoldsThePoint_TakesNothing) {
  EXPECT_EQ(light_of_first(pair_of_fibres({0, 0.0009f, 0}), {}), 1.0f);
  EXPECT_EQ(light_of_first(pair_of_fibres({0, 0.0011f, 0}), {}), 0.0f);
}

// The other fibre lies before one side of the first.
TEST(ShadowTruth, SideThatIsSeen_IsWhereLightArrives) {
  const strands::Groom groom = pair_of_fibres({0, 0.003f, 0.0012f});
  EXPECT_EQ(light_of_first(groom, {}), 1.0f);
  EXPECT_EQ(light_of_first(groom, glm::dvec3(0, 0, 1)), 0.0f);
  EXPECT_EQ(light_of_first(groom, glm::dvec3(0, 0, -1)), 1.0f);
  EXPECT_EQ(light_of_first(groom, glm::dvec3(0.5, 0, 1)), 0.0f) << "the viewer's place along the fibre is the same";
}

// The mean over points of the strands does not depend on the disc, because no disc lets a fibre shadow itself, however
// much it leans to the light.
TEST(ShadowTruth, AnyFootprint_SameMean) {
  const strands::Groom groom = tests::random_slab(5000, 0.3, 0.1, 1e-4f, 7);
  std::vector<glm::vec3> points;
  std::vector<std::uint32_t> strands;
  for (std::uint32_t v = 0; v < groom.vertex_count(); ++v) {
    const glm::vec3& p = groom.positions[v];
    if (std::abs(p.x) > 0.03f || std::abs(p.z) > 0.03f) continue;
    points.push_back(p);
    strands.push_back(v / 16);
  }
  std::vector<double> means;
  for (const std::string disc : {"0.1", "1", "5", "23"}) {
    auto result = run(groom, {points, strands}, "rays=9,footprint_radius_mm=" + disc, 0.4, {0.6, 1, 0.2});
    ASSERT_TRUE(result);
    means.push_back(mean(result->values));
    std::printf("disc of %s mm: mean T %.4f over %zu points\n", disc.c_str(), means.back(), points.size());
  }
  for (const double value : means) EXPECT_NEAR(value, means.back(), 0.015);
}

TEST(ShadowTruth, OneAndThreeThreads_SameBits) {
  const strands::Groom groom = tests::coat(1000, 6, 0.03, 1e-4f, 3);
  const Receivers receivers{std::span(groom.positions).first(100)};
  Result<Transmittance> results[2] = {Error{}, Error{}};
  for (int i = 0; i < 2; ++i) {
    tbb::global_control threads(tbb::global_control::max_allowed_parallelism, i == 0 ? 1 : 3);
    results[i] = run(groom, receivers, "rays=64", 0.4, {1, 1, 0.3});
    ASSERT_TRUE(results[i]);
  }
  EXPECT_EQ(results[0]->values, results[1]->values);
  EXPECT_EQ(results[0]->standard_error, results[1]->standard_error);
}

TEST(ShadowTruth, BadInput_IsRefused) {
  const glm::vec3 good(0), bad(std::numeric_limits<float>::quiet_NaN());
  const std::uint32_t strand = 5;
  EXPECT_FALSE(run(bar(), {std::span(&good, 1)}, "", 0.4, {0, 0, 0}));
  EXPECT_FALSE(run(bar(), {std::span(&good, 1)}, "", -0.1));
  EXPECT_FALSE(run(bar(), {std::span(&bad, 1)}, ""));
  EXPECT_FALSE(run(bar(), {std::span(&good, 1), std::span(&strand, 1)}, ""));
  EXPECT_FALSE(run(bar(), {std::span(&good, 1)}, "rays=0"));
}

}  // namespace cuticle::shadows::shadow_truth_test
