#include <cmath>
#include <numeric>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <glm/geometric.hpp>

#include "shadows/method.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::shadows::voxel_test {

namespace {

Result<Transmittance> run(const strands::Groom& groom, std::span<const glm::vec3> points, const std::string& set,
                          double alpha = 0.4, glm::dvec3 light = {0, 1, 0}) {
  const Method& method = **find_method("voxel");
  auto values = registry::parse_assignments(method.entry.parameters, set);
  if (!values) return values.error();
  return method.evaluate({&groom, alpha, light}, {points, {}}, *values);
}
double mean_of(const strands::Groom& groom, std::span<const glm::vec3> points, const std::string& set,
               glm::dvec3 light = {0, 1, 0}) {
  auto result = run(groom, points, set, 0.4, light);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  if (!result) return -1;
  return std::accumulate(result->values.begin(), result->values.end(), 0.0) / double(points.size());
}
strands::Groom slab() { return tests::random_slab(6000, 0.1, 0.05, 2e-5f, 7); }

/// Straight level fibres above or below a point of the ground plan.
int crossings_at(const strands::Groom& groom, const glm::dvec2& point) {
  int crossings = 0;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const glm::dvec3 a(groom.positions[groom.offsets[s]]), b(groom.positions[groom.offsets[s + 1] - 1]);
    const glm::dvec2 along(b.x - a.x, b.z - a.z), from_a(point.x - a.x, point.y - a.z);
    const double across = std::abs(from_a.x * along.y - from_a.y * along.x) / glm::length(along);
    crossings += across < double(groom.radii[groom.offsets[s]]) ? 1 : 0;
  }
  return crossings;
}
/// Mean of (1 - alpha)^crossings over the square of `grid_below`.
double mean_of_crossings(const strands::Groom& groom, double alpha) {
  constexpr int k_side = 200;
  double sum = 0;
  for (int i = 0; i < k_side * k_side; ++i)
    sum += std::pow(
        1 - alpha, crossings_at(groom, 0.04 * (glm::dvec2(i % k_side + 0.5, i / k_side + 0.5) / double(k_side) - 0.5)));
  return sum / (k_side * k_side);
}

}  // namespace

TEST(Voxel, RandomSlab_FollowsTheExponentialLaw) {
  const strands::Groom groom = slab();
  for (const double height : {-0.001, 0.025}) {
    const double area = 4e-5 * tests::length_per_area(groom, 0.02, height);
    EXPECT_NEAR(mean_of(groom, tests::grid_below(height), "resolution=96") / std::exp(-0.4 * area), 1, 0.01);
  }
}

// Cells of 6.5 to 0.8 of a fibre's width: that a ray sees a fibre through the weights of cells must not make the mean
// lighter.
TEST(Voxel, CellsNearTheFibresSize_KeepTheMean) {
  const strands::Groom groom = tests::random_slab(400, 0.1, 0.05, 3e-4f, 7);
  const double mean = mean_of_crossings(groom, 0.4);
  for (const char* set : {"resolution=64", "resolution=256", "resolution=512"})
    EXPECT_NEAR(mean_of(groom, tests::grid_below(-0.001), set) / mean, 1, 0.01) << set;
}

// Cells of 1.9 to 0.24 of a fibre's width, of opaque fibres too: a fibre wider than a cell lies in lanes.
TEST(Voxel, CellsNarrowerThanTheFibres_KeepTheMean) {
  const strands::Groom groom = tests::random_slab(60, 0.1, 0.05, 1e-3f, 7);
  const auto points = tests::grid_below(-0.001);
  for (const double alpha : {0.4, 1.0})
    for (const char* set : {"resolution=64", "resolution=128", "resolution=256", "resolution=512"}) {
      const auto result = run(groom, points, set, alpha);
      ASSERT_TRUE(result);
      const double mean = std::accumulate(result->values.begin(), result->values.end(), 0.0) / double(points.size());
      std::printf("alpha %.1f, %s: %.4f of %.4f\n", alpha, set, mean, mean_of_crossings(groom, alpha));
      EXPECT_NEAR(mean, mean_of_crossings(groom, alpha), 0.012) << set << ", alpha " << alpha;
    }
}

// Fibres crossed square on show 4/pi of their mean over directions.
TEST(Voxel, IsotropicForm_CountsTheMeanWidth) {
  const strands::Groom groom = slab();
  const auto points = tests::grid_below(-0.001);
  const double anisotropic = -std::log(mean_of(groom, points, "")),
               isotropic = -std::log(mean_of(groom, points, "form=isotropic"));
  EXPECT_NEAR(isotropic / anisotropic, 3.14159265 / 4, 0.005);
}

TEST(Voxel, LightAlongTheFibres_OnlyTheIsotropicFormCasts) {
  strands::Groom groom;
  for (int i = 0; i < 400; ++i)
    tests::add_strand(
        groom,
        {{0.001f * float(i % 20), 0, 0.001f * float(i / 20)}, {0.001f * float(i % 20), 0.05f, 0.001f * float(i / 20)}},
        1e-4f);
  const glm::vec3 point(0.01f, -0.01f, 0.01f);
  EXPECT_GT(mean_of(groom, std::span(&point, 1), ""), 0.999);
  EXPECT_LT(mean_of(groom, std::span(&point, 1), "form=isotropic"), 0.3);
}

TEST(Voxel, PointsFarOutside_AreLitOrBehindAll) {
  const strands::Groom groom = slab();
  const glm::vec3 lit[] = {{0, 1e6f, 0}, {1e6f, 0, 0}, {1e6f, -1e6f, 0}}, behind(0, -1e6f, 0), near(0, -0.01f, 0);
  EXPECT_EQ(mean_of(groom, lit, ""), 1.0);
  EXPECT_NEAR(mean_of(groom, std::span(&behind, 1), ""), mean_of(groom, std::span(&near, 1), ""), 0.02);
}

TEST(Voxel, WiderFilter_AveragesTheDisc) {
  strands::Groom groom;
  for (int i = 0; i < 40; ++i)
    tests::add_strand(groom, {{-0.05f, 0.001f * float(i), 0.05f}, {-0.05f, 0.001f * float(i), -0.05f}}, 2e-4f);
  tests::add_strand(groom, {{0.05f, 0, 0}, {0.05f, 0.001f, 0}}, 1e-6f);
  const glm::vec3 beside(-0.045f, -0.01f, 0);
  EXPECT_GT(mean_of(groom, std::span(&beside, 1), "resolution=128"), 0.99);
  EXPECT_LT(mean_of(groom, std::span(&beside, 1), "resolution=128,filter_radius_mm=10"), 0.97);
}

TEST(Voxel, StatedEdges_HaveDefinedValues) {
  strands::Groom groom;
  const glm::vec3 point(0, -0.001f, 0);
  EXPECT_EQ(mean_of(groom, std::span(&point, 1), ""), 1.0);
  tests::add_strand(groom, {{0, 0, 0}, {0, 0, 0}}, 0.5f);
  EXPECT_EQ(mean_of(groom, std::span(&point, 1), ""), 1.0);
  tests::add_strand(groom, {{-1e-3f, 0, 0}, {1e-3f, 0, 0}}, 0.5f);
  auto opaque = run(groom, std::span(&point, 1), "accumulate=optical_depth", 1);
  ASSERT_TRUE(opaque);
  EXPECT_TRUE(opaque->values[0] >= 0 && opaque->values[0] < 1e-4f);
  EXPECT_FALSE(run(groom, std::span(&point, 1), "", 0.4, {0, 0, 0}));
}

TEST(Voxel, OneAndThreeThreads_SameBits) {
  const strands::Groom groom = tests::coat(2000, 6, 0.03, 1e-4f, 3);
  std::vector<float> values[2];
  for (int i = 0; i < 2; ++i) {
    tbb::global_control threads(tbb::global_control::max_allowed_parallelism, i == 0 ? 1 : 3);
    auto result = run(groom, groom.positions, "", 0.4, {1, 1, 0.3});
    ASSERT_TRUE(result);
    values[i] = result->values;
  }
  EXPECT_EQ(values[0], values[1]);
}

}  // namespace cuticle::shadows::voxel_test
