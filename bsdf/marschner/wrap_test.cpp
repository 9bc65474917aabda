// The model on solid geometry: the principal tangent's frame, and the wrap term.
#include "bsdf/marschner/wrap.glslh"

#include <cmath>

#include <gtest/gtest.h>

namespace cuticle::bsdf::marschner::wrap_test {
namespace {

using Vector = glm::dvec3;

double length(const Vector& v) { return std::sqrt(inner_product(v, v)); }

TEST(WrapTerm, AtItsEdges_IsWhatItsNameSays) {
  EXPECT_EQ(wrap_term(0.0, 0.25), 0.25);
  EXPECT_EQ(wrap_term(0.0, -0.25), 0);
  EXPECT_EQ(wrap_term(0.5, 1.0), 1);
  EXPECT_DOUBLE_EQ(wrap_term(0.5, 0.1), 0.6 / 1.5);
  EXPECT_EQ(wrap_term(0.5, -0.5), 0);
  EXPECT_EQ(wrap_term(1.0, -1.0), 0);
}

TEST(WrapTerm, InFloat_IsWithinTwoRoundings) {
  for (int i = -100; i <= 100; ++i)
    EXPECT_NEAR(double(wrap_term(0.3f, float(i) / 100)), wrap_term(double(0.3f), double(float(i) / 100)), 1.2e-7);
}

TEST(SolidFrame, FromASlantedGrain_LiesInTheSurface) {
  const SolidFrame<double> frame = make_solid_frame(Vector(0, 0, 1), Vector(3, 0, 5));
  EXPECT_NEAR(length(frame.along - Vector(1, 0, 0)), 0, 1e-15);
  EXPECT_NEAR(inner_product(frame.across, frame.along), 0, 1e-15);
  EXPECT_NEAR(length(frame.across), 1, 1e-15);
}

TEST(SolidFrame, FromAGrainAlongTheNormal_StillHasATangent) {
  for (const Vector& normal : {Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0.6, 0.8)}) {
    const SolidFrame<double> frame = make_solid_frame(normal, 2.0 * normal);
    EXPECT_NEAR(inner_product(frame.along, normal), 0, 1e-15);
    EXPECT_NEAR(length(frame.along), 1, 1e-15);
  }
}

const Marschner<double> hair = make_marschner<double>(1.55, Vector(0.2), 0.26, -0.1);

TEST(SolidScattering, IsTheModelsSAtTheSurfacesAngles) {
  const SolidFrame<double> frame = make_solid_frame(Vector(0, 0, 1), Vector(1, 0, 0));
  const double theta_i = 0.3, theta_o = -0.2, phi = 0.9;  // the light stands over the surface, the viewer beside it
  const Vector light(std::sin(theta_i), 0, std::cos(theta_i));
  const Vector viewer(std::sin(theta_o), -std::cos(theta_o) * std::sin(phi), std::cos(theta_o) * std::cos(phi));
  const EvaluationPoint<double> at{theta_i, theta_o, (theta_o - theta_i) / 2, phi, 0, 0};
  const double expected = evaluate(hair, CUTICLE_QUANTITY_S, -1, at).x * (0.4 + std::cos(theta_i)) / 1.4;
  EXPECT_NEAR(solid_scattering(hair, frame, light, viewer, 0.4).x, expected, 1e-13 * expected);
}

// A sphere with its grain along the meridians, lit from above: the far side gets light as far as the wrap reaches, and
// everything is finite, the poles of the grain included.
TEST(SolidScattering, OverASphere_IsFiniteAndEndsWhereTheWrapDoes) {
  const Vector light(0.6, 0, 0.8), viewer(0, -0.6, 0.8);
  int lit_from_behind = 0;
  for (int i = 0; i <= 40; ++i)
    for (int k = 0; k < 40; ++k) {
      const double polar = i * M_PI / 40, around = k * M_PI / 20;
      const Vector normal(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
      const double value = solid_scattering(hair, make_solid_frame(normal, Vector(0, 0, 1)), light, viewer, 0.5).x;
      const double facing = inner_product(normal, light);
      ASSERT_TRUE(std::isfinite(value) && value >= 0);
      if (facing < -0.5 - 1e-12) {
        EXPECT_EQ(value, 0);
      }
      lit_from_behind += facing < 0 && value > 0;
    }
  EXPECT_GT(lit_from_behind, 100);
}

}  // namespace
}  // namespace cuticle::bsdf::marschner::wrap_test
