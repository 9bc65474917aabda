#include "strands/thickness.h"

#include <gtest/gtest.h>

namespace cuticle::strands::thickness_test {
namespace {

/// Fibres along x that fill a cube of 1 m, `across` of them each way, at the middles of equal parts.
Groom cube(int across, float radius) {
  Groom groom;
  for (int i = 0; i < across; ++i)
    for (int k = 0; k < across; ++k) {
      for (const float x : {0.0f, 0.5f, 1.0f})
        groom.positions.emplace_back(x, float(i) / float(across - 1), float(k) / float(across - 1));
      groom.offsets.push_back(std::uint32_t(groom.positions.size()));
    }
  groom.radii.assign(groom.positions.size(), radius);
  return groom;
}

// From two of three sides a fibre covers 2 r of 1 m, and 128 x 128 of them lie before 1 m^2; along them they have no
// area.
TEST(Thickness, CubeOfFibres_IsTheirAreaOverItsSides) {
  EXPECT_NEAR(optical_thickness(cube(128, 1e-4f)), 128 * 128 * 2e-4 * 2 / 3, 1e-4);
}

TEST(Thickness, WithTheRadius_Grows) {
  EXPECT_NEAR(optical_thickness(cube(64, 2e-4f)) / optical_thickness(cube(64, 1e-4f)), 2, 1e-6);
}

TEST(Thickness, WithoutHair_IsZero) {
  EXPECT_EQ(optical_thickness({}), 0);
  Groom point;
  point.positions.assign(2, {1, 2, 3});
  point.radii.assign(2, 1e-4f);
  point.offsets = {0, 2};
  EXPECT_EQ(optical_thickness(point), 0);
}

}  // namespace
}  // namespace cuticle::strands::thickness_test
