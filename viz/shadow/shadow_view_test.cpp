// The sheets, the volume and the ray of the view of shadow methods.
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "viz/shadow/shadow.h"

namespace cuticle::viz::shadow_view_test {
namespace {

/// A mat of 400 parallel hairs, 2 cm wide and 1 cm deep, lit from above.
ShadowView mat() {
  ShadowView view;
  view.name = "mat";
  for (int k = 0; k < 400; ++k) {
    // Rows are shifted against each other, so that no ray finds a gap through all.
    const float y = 0.5e-3F * float(k / 20), shift = std::fmod(0.618F * float(k / 20), 1.0F);
    const float x = 1e-3F * (float(k % 20) + shift);
    for (int v = 0; v < 5; ++v) view.groom.positions.emplace_back(x, y, 5e-3F * float(v));
    view.groom.offsets.push_back(std::uint32_t(view.groom.positions.size()));
  }
  view.groom.radii.assign(view.groom.positions.size(), 1e-4F);
  view.to_light = {0, 1, 0};
  return view;
}

TEST(OpacitySheets, Planes_StandAcrossTheLightFromTheNearestOn) {
  const auto sheets = opacity_sheets(mat(), 64).value();
  ASSERT_EQ(sheets.size(), 8u);
  for (std::size_t k = 0; k < sheets.size(); ++k)
    for (const glm::vec3& p : sheets[k].positions) {
      EXPECT_NEAR(p.y, sheets[k].positions[0].y, 1e-6F);
      if (k == 0) continue;
      EXPECT_LT(p.y, sheets[k - 1].positions[0].y);
    }
  EXPECT_NEAR(sheets.back().positions[0].y, 0, 1e-5F) << "the last plane lies at the far end of the hair";
}

TEST(DeepOpacitySheets, Depth_RisesFromLayerToLayer) {
  const auto sheets = deep_opacity_sheets(mat(), 64).value();
  for (std::size_t i = 0; i < sheets[0].depths.size(); ++i)
    for (std::size_t k = 1; k < sheets.size(); ++k)
      EXPECT_TRUE(!sheets[0].is_hair[i] || sheets[k].depths[i] >= sheets[k - 1].depths[i]);
}

TEST(DeepOpacitySheets, Layers_DivideTheHairOfEachTexel) {
  const auto sheets = deep_opacity_sheets(mat(), 64).value();
  for (std::size_t i = 0; i < sheets[0].positions.size(); ++i) {
    if (!sheets[0].is_hair[i]) continue;
    const float first = sheets.front().positions[i].y, last = sheets.back().positions[i].y;
    for (std::size_t k = 1; k < sheets.size(); ++k)
      ASSERT_NEAR(sheets[k].positions[i].y, first + float(k) / 7 * (last - first), 1e-5F) << i << " " << k;
  }
}

TEST(TransmittanceVolume, Hair_DarkensAwayFromTheLight) {
  const TransmittanceVolume volume = transmittance_volume(mat(), 16).value();
  const auto at = [&](int y) {
    return volume.values[std::size_t((volume.size.z / 2 * volume.size.y + y) * volume.size.x + volume.size.x / 2)];
  };
  EXPECT_GT(at(volume.size.y - 1), at(0));
}

TEST(DepthCurves, EveryMethod_EndsNearTheTruth) {
  ShadowView view = mat();
  view.methods = {"voxel"};
  view.through = glm::dvec3(0.0095, 0.005, 0.01);
  const auto curves = depth_curves(view).value();
  const double last = curves.back().points.back()[1];
  EXPECT_NEAR(last, 20 * 0.2 * -std::log(1 - 0.4), 0.8) << "20 rows, each covering a fifth";
  EXPECT_EQ(curves.back().points.front()[1], 0);
}

}  // namespace
}  // namespace cuticle::viz::shadow_view_test
