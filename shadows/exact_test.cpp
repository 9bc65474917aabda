#include <cmath>

#include <gtest/gtest.h>

#include "shadows/exact.glslh"

namespace cuticle::shadows::exact_test {

TEST(Exact, InverseSquareRoot_IsWithinThreeUnits) {
  double worst = 0;
  for (float x = 1e-9f; x < 1e9f; x *= 1.0007f)
    worst = std::max(worst, std::abs(double(exact_inverse_sqrt(x)) * std::sqrt(double(x)) - 1));
  EXPECT_LT(worst, 3e-7);
}

TEST(Exact, Reciprocal_IsWithinSixUnits) {
  double worst = 0;
  for (float x = 1e-9f; x < 1e9f; x *= 1.0007f)
    worst = std::max(worst, std::abs(double(exact_reciprocal(x)) * double(x) - 1));
  EXPECT_LT(worst, 6e-7);
}

TEST(Exact, Affine_SumsFromLeftToRight) {
  const glm::vec3 axis(1e8f, -1e8f, 1), point(1, 1, 1);
  EXPECT_EQ(exact_affine(axis, 0.5f, point), 1.5f);
}

}  // namespace cuticle::shadows::exact_test
