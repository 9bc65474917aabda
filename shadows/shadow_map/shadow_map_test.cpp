#include <cmath>

#include <gtest/gtest.h>

#include "shadows/light_frame.h"
#include "shadows/shadow_map/depth_map.h"
#include "tests/support/shadow_runs.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::shadows::shadow_map_test {

namespace {

/// A fibre of 10 mm across the light, 50 mm above two that only fix the size of the map.
strands::Groom bar() {
  strands::Groom groom;
  tests::add_strand(groom, {{-0.05f, 0.05f, 0}, {0, 0.05f, 0}, {0.05f, 0.05f, 0}}, 0.005f);
  for (const float z : {-0.05f, 0.05f}) tests::add_strand(groom, {{-0.05f, 0, z}, {0.05f, 0, z}}, 0.0001f);
  return groom;
}
float at(glm::vec3 point, const std::string& set = "", double alpha = 1) {
  return tests::shadow_at("shadow_map", bar(), point, set, alpha);
}

/// Parallel fibres 2 mm apart, a tenth as wide, in a plane across the light.
strands::Groom grating() {
  strands::Groom groom;
  for (int i = -50; i < 50; ++i) {
    const float x = 0.002f * float(i);
    tests::add_strand(groom, {{x, 0, -0.1f}, {x + 0.013f, 0, 0.004f}, {x + 0.05f, 0, 0.1f}}, 1e-4f);
  }
  return groom;
}
/// Mean T of points behind its middle.
double behind_grating(const std::string& set, double alpha) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) points.emplace_back(0.0007f * float(i), -0.01f, 0.0013f * float(j - 32));
  return tests::mean(tests::run_shadow("shadow_map", grating(), points, set, alpha)->values);
}

}  // namespace

TEST(ShadowMap, Fibre_LightsWhatIsBeforeItAndDarkensWhatIsBehind) {
  EXPECT_EQ(at({0, 0.06f, 0}), 1.0f);
  EXPECT_LT(at({0, 0.04f, 0}), 2e-5f);
  EXPECT_EQ(at({0, 0.04f, 0.02f}), 1.0f) << "beside it";
}

TEST(ShadowMap, Bias_MovesTheTestByItsMillimetres) {
  for (const double bias : {0.5, 2.0, 10.0}) {
    const std::string set = "bias_mm=" + std::to_string(bias);
    EXPECT_EQ(at({0, float(0.05 - 0.98e-3 * bias), 0}, set), 1.0f) << bias;
    EXPECT_LT(at({0, float(0.05 - 1.02e-3 * bias), 0}, set), 2e-5f) << bias;
  }
}

TEST(ShadowMap, FilterAtTheEdge_IsHalfLit) {
  EXPECT_NEAR(at({0, 0.04f, 0.005f}, "filter_texels=8,resolution=512"), 0.5, 0.05);
  const float one_tap = at({0, 0.04f, 0.0045f}, "filter_texels=0");
  EXPECT_TRUE(one_tap == 1 || one_tap < 2e-5f) << one_tap;
}

TEST(ShadowMap, AbsorbingHair_TakesAlphaPerSpacing) {
  EXPECT_NEAR(at({0, 0.03f, 0}, "hair=absorbing,fibre_spacing_mm=10", 0.4), 0.36, 1e-3);
  EXPECT_NEAR(at({0, 0.03f, 0}, "hair=absorbing,fibre_spacing_mm=10,bias_mm=10", 0.4), 0.6, 1e-3);
}

// Fibres thinner than a texel count where they hold its centre: as often as their area says. Drawn as lines, one or two
// texels wide, opaque ones took all, .56 and .22 of the light of these maps, where .11 is right.
TEST(ShadowMap, FibresThinnerThanATexel_TakeTheirArea) {
  const double spacing_across = 0.002 * std::cos(std::atan2(0.043, 0.1));  // the slope varies by a tenth along a fibre
  const double share = 2e-4 / spacing_across;
  for (const std::string resolution : {"64", "256", "1024"})
    for (const double alpha : {1.0, 0.4})
      EXPECT_NEAR(behind_grating("resolution=" + resolution, alpha), 1 - alpha * share, 0.012)
          << resolution << ", opacity " << alpha;
}

TEST(ShadowMap, FibresOfSmallOpacity_LetTheirShareThrough) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 500; ++i) points.emplace_back(-0.045f + 0.00018f * float(i), 0.04f, 0.003f * std::sin(float(i)));
  for (const double alpha : {0.1, 0.4, 0.9}) {
    const auto values = tests::run_shadow("shadow_map", bar(), points, "resolution=512", alpha)->values;
    EXPECT_NEAR(tests::mean(values), 1 - alpha, 0.04) << alpha;
  }
}

TEST(ShadowMap, ClearFibres_CastNothing) { EXPECT_EQ(at({0, 0, 0}, "", 0), 1.0f); }

}  // namespace cuticle::shadows::shadow_map_test
