// Facets against the definitions of their distributions (Walter et al. 2007), integrated over slopes.
#include "study/oracle/microsurface.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace cuticle::study::oracle::microsurface_test {
namespace {

using glm::dvec3;

/// Density of the facets' slopes (x, y).
double slope_density(const Microsurface& s, double x, double y) {
  const double a2 = s.roughness * s.roughness, t = (x * x + y * y) / a2;
  const double shape = s.facets == Facets::ggx ? 1 / ((1 + t) * (1 + t)) : std::exp(-t);
  return shape / (std::numbers::pi * a2);
}

/// The area of facets visible from `toward` per area of the mesosurface, and the sums of their normals weighted by it.
struct Visible {
  double area = 0;
  dvec3 normals{0};
};
/// Slopes tan(a), as GGX has long tails.
Visible integrate(const Microsurface& s, dvec3 toward) {
  Visible sum;
  const int count = 800;
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < count; ++k) {
      const double x = std::tan(std::numbers::pi * ((i + 0.5) / count - 0.5)) * s.roughness;
      const double y = std::tan(std::numbers::pi * ((k + 0.5) / count - 0.5)) * s.roughness;
      const double stretch = (s.roughness + x * x / s.roughness) * (s.roughness + y * y / s.roughness);
      const double cell = stretch * std::numbers::pi * std::numbers::pi / (double(count) * count);
      const double seen = std::max(0.0, toward.z - x * toward.x - y * toward.y) * slope_density(s, x, y) * cell;
      sum.area += seen;
      sum.normals += seen * glm::normalize(dvec3(-x, -y, 1));
    }
  return sum;
}

struct Case {
  Facets facets;
  double roughness, sine;
  bool from_below;
  dvec3 toward() const { return {0.6 * sine, 0.8 * sine, (from_below ? -1 : 1) * std::sqrt(1 - sine * sine)}; }
};
class MicrosurfaceTest : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Views, MicrosurfaceTest,
                         testing::Values(Case{Facets::ggx, 0.3, 0.9, false}, Case{Facets::ggx, 0.8, 0.9, true},
                                         Case{Facets::beckmann, 0.3, 0.9, false},
                                         Case{Facets::beckmann, 0.8, 0.9, true},
                                         Case{Facets::beckmann, 0.5, 0, false}));

TEST_P(MicrosurfaceTest, Lambda_IsTheMaskedShareOfTheFacets) {
  const Microsurface s{GetParam().facets, GetParam().roughness};
  const dvec3 toward = GetParam().toward();
  EXPECT_NEAR(toward.z * (1 + smith_lambda(s, toward.z)), integrate(s, toward).area, 2e-3);
}

TEST_P(MicrosurfaceTest, VisibleNormals_HaveTheMeanOfTheirDistribution) {
  const Microsurface s{GetParam().facets, GetParam().roughness};
  const dvec3 toward = GetParam().toward();
  const Visible truth = integrate(s, toward);
  dvec3 sum(0);
  const int count = 200000;
  RandomStream random(1);
  for (int i = 0; i < count; ++i) sum += visible_normal(s, toward, random);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / count, truth.normals[c] / truth.area, 4e-3) << c;
}

TEST(Microsurface, ZeroRoughness_IsAMirror) {
  RandomStream random(1);
  for (int i = 0; i < 100; ++i)
    for (Blocked blocked : {Blocked::lost, Blocked::followed}) {
      const Meeting m = meet_surface({Facets::ggx, 0}, blocked, {0.6, 0, -0.8}, 1, 1.5, random);
      EXPECT_EQ(m.energy, 1);
      EXPECT_NEAR(m.direction.x, m.below ? 0.4 : 0.6, 1e-15);
    }
}

// Light followed from facet to facet obeys the flux form of reciprocity: what goes from the lower to the upper side
// over all angles balances with what goes down, times the ratio of the squared indices.
TEST(Microsurface, FollowedLight_CrossesBothWaysInBalance) {
  const double eta = 1.5;
  const int count = 200000;
  std::array<double, 2> passed{};
  for (int side = 0; side < 2; ++side) {
    RandomStream random(3, std::uint64_t(side));
    for (int i = 0; i < count; ++i) {
      const double sine = std::sqrt(random.next_unit());  // diffuse light
      const Meeting m = meet_surface({Facets::ggx, 0.7}, Blocked::followed, {sine, 0, -std::sqrt(1 - sine * sine)},
                                     side == 0 ? 1 : eta, side == 0 ? eta : 1, random);
      passed[std::size_t(side)] += m.below ? m.energy : 0;
    }
  }
  EXPECT_NEAR(passed[0] / count, passed[1] / count * eta * eta, 0.01);
}

}  // namespace
}  // namespace cuticle::study::oracle::microsurface_test
