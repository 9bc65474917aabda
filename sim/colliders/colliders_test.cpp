// Spheres with pearls against geometry.
#include "sim/classic/test_strands.h"
#include "sim/colliders/contact.glslh"

namespace cuticle::sim::colliders_test {
namespace {

using namespace testing;

/// How deep vertices and whole segments are inside the sphere, metres (negative: clear of it).
struct Penetration {
  double vertices = -1, segments = -1;
};
double distance_to_segment(glm::dvec3 point, glm::dvec3 a, glm::dvec3 b) {
  const glm::dvec3 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0 ? glm::clamp(glm::dot(point - a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(point, a + t * along);
}
Penetration penetration(const strands::Groom& rest, const State& state, const Sphere& sphere) {
  Penetration deepest;
  for (std::size_t s = 0; s < rest.strand_count(); ++s)
    for (std::size_t i = rest.offsets[s] + 2; i < rest.offsets[s + 1]; ++i) {
      const glm::dvec3 a(state.positions[i - 1]), b(state.positions[i]);
      deepest.vertices = std::max(deepest.vertices, sphere.radius - glm::distance(b, sphere.center));
      deepest.segments = std::max(deepest.segments, sphere.radius - distance_to_segment(sphere.center, a, b));
    }
  return deepest;
}

Penetration deeper(const Penetration& a, const Penetration& b) {
  return {std::max(a.vertices, b.vertices), std::max(a.segments, b.segments)};
}

/// The deepest that strands of four long segments ever get while they fall across a ball.
Penetration fallen_on_ball(const std::string& settings) {
  strands::Groom groom;
  for (int s = 0; s < 5; ++s) add_straight(groom, {0, 0.03, 0.002 * (s - 2)}, {1, 0, 0}, uniform_segments(4, 0.4));
  const Sphere ball{{0.1, -0.03, 0}, 0.05};
  auto solver = make_classic(groom, k_free + ",damping=2,iterations=16", gravity_and_colliders(settings));
  Penetration worst;
  for (int frame = 0; frame < 60; ++frame)
    worst = deeper(worst, penetration(groom, run_still(*solver, 1, 1.0 / 30, {&ball, 1}), ball));
  return worst;
}

TEST(Colliders, FittedPearls_KeepVerticesAndSegmentsOut) {
  const Penetration depth = fallen_on_ball("pearl_radius=0,fit_pearls=true");
  std::printf("fitted pearls, ball of 50 mm, segments of 100 mm: vertices %.2e m, segments %.2e m\n", depth.vertices,
              depth.segments);
  EXPECT_LT(depth.vertices, 1e-5);
  EXPECT_LT(depth.segments, 1e-4);
}

TEST(Colliders, PointParticles_LetLongSegmentsCutThrough) {
  const Penetration depth = fallen_on_ball("pearl_radius=0,fit_pearls=false");
  std::printf("no pearls: vertices %.2e m, segments %.2e m\n", depth.vertices, depth.segments);
  EXPECT_GT(depth.segments, 5e-3);
}

TEST(Colliders, MovingHeadWithItsSphere_HairStaysOutside) {
  const strands::Groom groom = ring(32);
  const Sphere head{{0, 0, 0}, 0.095};
  auto solver = make_classic(groom, "shape_stiffness=3", gravity_and_colliders());
  Penetration worst;
  for (int frame = 0; frame < 60; ++frame) {
    FrameInput input = frame_of(frame);
    input.colliders = {&head, 1};
    ASSERT_TRUE(solver->advance(input).ok());
    const Sphere moved{glm::dvec3(input.head_end * glm::dvec4(head.center, 1)), head.radius};
    worst = deeper(worst, penetration(groom, *solver->state(), moved));
  }
  std::printf("turning head of 95 mm: deepest vertex %.2e m, segment %.2e m\n", worst.vertices, worst.segments);
  EXPECT_LT(worst.vertices, 1e-5);
  EXPECT_LT(worst.segments, 1e-4);
}

TEST(Colliders, SphereThatEngulfsTheRoot_NeitherStretchesNorExplodes) {
  const strands::Groom groom = ring(8);
  for (double radius : {0.15, 0.3, 5.0}) {
    const Sphere ball{{0, 0, 0}, radius};
    auto solver = make_classic(groom, "iterations=16", gravity_and_colliders());
    const State state = run_still(*solver, 120, 1.0 / 30, {&ball, 1});
    EXPECT_TRUE(all_finite(state)) << radius;
    EXPECT_LT(worst_stretch(groom, state), 0.05) << radius;
    for (const glm::vec3& velocity : state.velocities) EXPECT_LT(glm::length(velocity), 0.05f) << radius;
  }
}

TEST(Colliders, OverlapAtTheStart_GivesNoVelocity) {
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, uniform_segments(8, 0.3));
  const Sphere ball{{0.15, -0.045, 0}, 0.05};
  auto solver = make_classic(groom, k_free + ",iterations=16", {{"colliders", settings_of("colliders")}});
  double fastest = 0;
  for (int k = 0; k < 30; ++k)
    for (const glm::vec3& velocity : run_still(*solver, 1, 1.0 / 30, {&ball, 1}).velocities)
      fastest = std::max(fastest, double(glm::length(velocity)));
  std::printf("strand that starts 5 mm deep: fastest afterwards %.3f m/s\n", fastest);
  EXPECT_LT(fastest, 0.5);  // leaving 5 mm within one substep would be 1.2 m/s
}

TEST(Colliders, WithoutTheEffect_SpheresAreNotThere) {
  const strands::Groom groom = ring(4);
  const Sphere head{{0, 0, 0}, 0.2};
  auto with = make_classic(groom, "", gravity()), without = make_classic(groom, "", gravity());
  EXPECT_EQ(run_frames(*with, 10, {&head, 1}).positions, run_frames(*without, 10).positions);
}

TEST(Pearl, FittedRadius_PutsTheMiddleOfASegmentOnTheSphere) {
  for (double segment : {1e-6, 0.01, 0.3, 10.0}) {
    const double held = 0.1 + fitted_pearl(0.1, segment);
    EXPECT_NEAR(std::sqrt(held * held - segment * segment / 4), 0.1, 1e-13) << segment;
  }
}

TEST(Pearl, NoSphereAndNoSegment_IsZero) { EXPECT_EQ(fitted_pearl(0.0, 0.0), 0.0); }

}  // namespace
}  // namespace cuticle::sim::colliders_test
