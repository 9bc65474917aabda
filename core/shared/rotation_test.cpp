// Cosine and sine together against each alone.
#include "core/shared/rotation.glslh"

#include <gtest/gtest.h>

namespace cuticle::rotation_test {
namespace {

template <class Real>
int differences() {
  int found = 0;
  for (int k = -200000; k <= 200000; ++k) {
    const Real x = Real(0.0004096) * Real(k);
    const glm::vec<2, Real> both = precise_rotation(x);
    if (both.x != precise_cos(x) || both.y != precise_sin(x)) ++found;
  }
  return found;
}
TEST(PreciseRotation, InFloat_IsTheCosineAndTheSine) { EXPECT_EQ(differences<float>(), 0); }
TEST(PreciseRotation, InDouble_IsTheCosineAndTheSine) { EXPECT_EQ(differences<double>(), 0); }

}  // namespace
}  // namespace cuticle::rotation_test
