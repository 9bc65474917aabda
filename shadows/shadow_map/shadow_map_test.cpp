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
float at(glm::vec3 point, const std::string& set = "", double alpha = 0.4) {
  return tests::shadow_at("shadow_map", bar(), point, set, alpha);
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
  EXPECT_NEAR(at({0, 0.03f, 0}, "hair=absorbing,fibre_spacing_mm=10,bias_mm=0"), 0.36, 1e-3);
  EXPECT_NEAR(at({0, 0.03f, 0}, "hair=absorbing,fibre_spacing_mm=10,bias_mm=10"), 0.6, 1e-3);
}

TEST(ShadowMap, ClearFibres_CastNothing) { EXPECT_EQ(at({0, 0, 0}, "", 0), 1.0f); }

}  // namespace cuticle::shadows::shadow_map_test
