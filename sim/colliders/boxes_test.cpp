// Capsules and boxes against geometry, for the solvers of rigid links.
#include "sim/chains/contact/box_contact.glslh"
#include "sim/chains/test_stability.h"

namespace cuticle::sim::boxes_test {
namespace {

using namespace testing;

const std::string k_limp = "damping=5,clamped_vertices=1";
/// Hair that no rest pose holds.
std::string limp(std::string_view solver) {
  return k_limp + (solver == "rod" ? ",sag_free=false" : ",shape_stiffness=0");
}

/// Independent of the formulas under test: by the distance from the axis, or the nearest place of the box.
double depth_in(const RoundedBox& box, const glm::dvec3& place) {
  if (box.half_size.x == 0 && box.half_size.z == 0) {
    const glm::dvec3 axis = box.axes[1] * box.half_size.y;
    return box.radius - distance_to_segment(place, box.center - axis, box.center + axis);
  }
  const glm::dvec3 local = glm::transpose(box.axes) * (place - box.center),
                   nearest = glm::clamp(local, -box.half_size, box.half_size);
  if (nearest != local) return box.radius - glm::distance(local, nearest);
  const glm::dvec3 room = box.half_size - glm::abs(local);
  return box.radius + std::min({room.x, room.y, room.z});
}

RoundedBox moved(const RoundedBox& box, const glm::dmat4& head) {
  return {glm::dvec3(head * glm::dvec4(box.center, 1)), glm::dmat3(head) * box.axes, box.half_size, box.radius};
}

double deepest(const strands::Groom& groom, const State& state, const RoundedBox& box) {
  return deepest_segment(groom, state, [&](const glm::dvec3& place) { return depth_in(box, place); });
}

State run_beside(Solver& solver, int frames, double duration, std::span<const RoundedBox> boxes) {
  for (int k = 0; k < frames; ++k)
    EXPECT_TRUE(solver.advance({.duration = duration, .colliders = {}, .boxes = boxes}).ok());
  return solver.state().value();
}

glm::dmat3 turned_about(const glm::dvec3& axis, double angle) {
  return glm::dmat3(glm::rotate(glm::dmat4(1), angle, axis));
}

struct BoxCase {
  const char* name;
  RoundedBox box;
  double resting;  ///< m/s of the tip of `exact`; over a sharp edge a strand keeps trembling
  int first = 0;   ///< frame in which it is outside: an overlap is left at 0.25 m/s
};
const BoxCase k_boxes[] = {
    {"capsule across", make_capsule({0.02, -0.06, -0.2}, {0.02, -0.06, 0.2}, 0.05), 1e-3},
    {"capsule aslant", make_capsule({-0.05, -0.05, -0.2}, {0.1, -0.12, 0.2}, 0.05), 1e-3},
    {"capsule thinner than a link", make_capsule({-0.002, -0.03, -0.2}, {0.008, -0.03, 0.2}, 0.003), 1e-3},
    {"end of a capsule", make_capsule({0.015, -0.05, 0}, {0.015, -0.3, 0.01}, 0.03), 1e-3},
    {"box, sharp", {{0.04, -0.06, 0}, glm::dmat3(1), {0.06, 0.03, 0.1}, 0}, 6e-3},
    {"box, on its edge", {{0.02, -0.08, 0}, turned_about({0, 0, 1}, 0.7), {0.04, 0.04, 0.2}, 0}, 6e-3},
    {"box, rounded and aslant",
     {{0.04, -0.09, 0}, turned_about(glm::normalize(glm::dvec3(1, 2, 3)), 0.9), {0.05, 0.02, 0.1}, 0.02},
     1e-3},
    {"starts inside", {{0.07, -0.01, 0}, glm::dmat3(1), {0.04, 0.03, 0.05}, 0.005}, 1e-3, 8}};

TEST(BoxContact, StrandsAcrossThem_KeepLengthAndStayOutside) {
  for (const char* solver : {"exact", "rod"})
    for (const BoxCase& c : k_boxes) {
      const strands::Groom groom = one(uniform_segments(31, 0.3), {1, 0, 0});
      auto made = make_solver(solver, groom, limp(solver), gravity_and_colliders("pearl_radius=0"));
      double stretch = 0, depth = -1, squares = 0;
      for (int k = 0; k < 360; ++k) {
        const State state = run_beside(*made, 1, 1.0 / 60, {&c.box, 1});
        stretch = std::max(stretch, worst_over_bound(groom, state));
        if (k % 4 == 0 && k >= c.first) depth = std::max(depth, deepest(groom, state, c.box));
        if (k < 300) continue;
        squares += std::pow(double(glm::length(state.velocities.back())), 2) / 60;
      }
      std::printf("%-5s %-28s stretch over bound %.2f, deepest segment %.1e m, tip after 5 s %.1e m/s\n", solver,
                  c.name, stretch, depth, std::sqrt(squares));
      EXPECT_LE(stretch, 1) << c.name;
      EXPECT_LT(depth, 2.5e-5) << c.name;
      EXPECT_LT(std::sqrt(squares), solver == std::string("rod") ? 0.12 : c.resting) << c.name;
    }
}

TEST(BoxContact, CapsuleWithoutLength_HoldsAStrandAsTheSphereDoes) {
  const strands::Groom groom = one(uniform_segments(31, 0.3), {1, 0, 0});
  const Sphere sphere{{0.05, -0.2, 0}, 0.08};
  const RoundedBox ball = make_capsule(sphere.center, sphere.center, sphere.radius);
  auto by_sphere = make_exact(groom, limp("exact"), gravity_and_colliders());
  auto by_box = make_exact(groom, limp("exact"), gravity_and_colliders());
  const State a = run_still(*by_sphere, 300, 1.0 / 60, {&sphere, 1}),
              b = run_beside(*by_box, 300, 1.0 / 60, {&ball, 1});
  std::printf("ball as sphere and as capsule: %.1e m apart at rest\n", worst_distance(a.positions, b.positions));
  EXPECT_LT(worst_distance(a.positions, b.positions), 1e-4);
}

TEST(BoxContact, BoxThatEngulfsTheRoot_LengthWins) {
  for (const char* solver : {"exact", "rod"})
    for (double half : {0.15, 0.3, 5.0}) {
      const strands::Groom groom = ring(8);
      const RoundedBox box{{0, 0, 0}, glm::dmat3(1), glm::dvec3(half), 0};
      auto made = make_solver(solver, groom, "", gravity_and_colliders());
      const State state = run_beside(*made, 60, 1.0 / 30, {&box, 1});
      EXPECT_TRUE(all_finite(state)) << solver << half;
      EXPECT_EQ(state.guards_fired, 0u);
      EXPECT_LT(worst_stretch(groom, state), 1e-4) << solver << half;
    }
}

TEST(BoxContact, CapsuleFasterThanAStrandsLengthPerStep_NeitherStretchesNorExplodes) {
  for (const char* solver : {"exact", "rod"}) {
    const strands::Groom groom = ring(8);
    auto made = make_solver(solver, groom, "damping=5,inner_step=100,max_substeps=1", gravity_and_colliders());
    double stretch = 0;
    for (int k = 0; k < 60; ++k) {
      const double x = (k % 2 ? 0.25 : -0.25) + 0.4 * (k % 3 - 1);
      const RoundedBox capsule = make_capsule({x, 0.1, -0.3}, {x, 0.12, 0.3}, 0.06);
      const State state = run_beside(*made, 1, 1.0 / 60, {&capsule, 1});
      ASSERT_TRUE(all_finite(state)) << solver << k;
      EXPECT_EQ(state.guards_fired, 0u);
      stretch = std::max(stretch, worst_over_bound(groom, state));
    }
    const double later = fastest(run_beside(*made, 600, 1.0 / 60, {}));
    std::printf("%s, capsule at up to 54 m/s: stretch over bound %.2f, fastest 10 s later %.2f m/s\n", solver, stretch,
                later);
    EXPECT_LE(stretch, 1) << solver;
    EXPECT_LT(later, 3.5) << solver;  // a fall over twice the length
  }
}

TEST(BoxContact, TurningHead_TakesThemAlong) {
  for (const char* solver : {"exact", "rod"}) {
    const strands::Groom groom = ring(16);
    const RoundedBox slab{{0, 0, 0}, turned_about({0, 1, 0}, 0.4), {0.07, 0.2, 0.04}, 0.004};
    auto made = make_solver(solver, groom, limp(solver), gravity_and_colliders("pearl_radius=0"));
    double depth = -1;
    for (int k = 0; k < 60; ++k) {
      FrameInput input = frame_of(k);
      input.boxes = {&slab, 1};
      ASSERT_TRUE(made->advance(input).ok());
      depth = std::max(depth, deepest(groom, *made->state(), moved(slab, input.head_end)));
    }
    std::printf("%s, turning head with a slab: deepest segment %.1e m\n", solver, depth);
    EXPECT_LT(depth, 2e-6) << solver;
  }
}

TEST(BoxContact, Incline_SticksBelowAndSlidesAboveTheAngleOfFriction) {
  // A strand lies across a slab that falls off at 20 degrees; tan 20 deg = 0.364.
  const double slope = 20 * 3.14159265358979 / 180;
  const glm::dvec3 normal(std::sin(slope), std::cos(slope), 0);
  const RoundedBox slab{-0.5 * normal, turned_about({0, 0, 1}, -slope), {2, 0.5, 2}, 0};
  for (double friction : {0.25, 0.5}) {
    strands::Groom groom;
    add_straight(groom, 1e-5 * normal, {0, 0, 1}, uniform_segments(20, 0.2));
    auto solver =
        make_exact(groom, k_free, gravity_and_colliders("pearl_radius=0,friction=" + std::to_string(friction)));
    const double slid = worst_distance(run_beside(*solver, 60, 1.0 / 60, {&slab, 1}).positions, groom.positions);
    std::printf("incline of 20 deg, friction %.2f: moved %.4f m in 1 s\n", friction, slid);
    EXPECT_EQ(slid<1e-3, friction> 0.364) << slid;
    EXPECT_EQ(slid > 0.05, friction < 0.364) << slid;
  }
}

TEST(BoxContact, BoxOutOfReach_ChangesNoBit) {
  const strands::Groom groom = ring(4);
  const RoundedBox far{{3, 0, 0}, glm::dmat3(1), {1, 1, 1}, 0};
  auto with = make_exact(groom, "", gravity_and_colliders()), without = make_exact(groom, "", gravity_and_colliders());
  EXPECT_EQ(run_beside(*with, 10, 1.0 / 30, {&far, 1}).positions, run_beside(*without, 10, 1.0 / 30, {}).positions);
}

void expect_refused(std::string_view solver, const RoundedBox& box, std::string_view why) {
  const auto result =
      make_solver(solver, ring(1), "", gravity_and_colliders())->advance({.colliders = {}, .boxes = {&box, 1}});
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, ::testing::HasSubstr(std::string(why)));
}
TEST(BoxContact, WhatIsNoBox_IsRefusedByName) {
  expect_refused("exact", {.half_size = {1, -1, 1}}, "half size (1, -1, 1)");
  expect_refused("exact", {.center = {0, std::nan(""), 0}}, "boxes[0]: centre (0, nan");
  expect_refused("rod", {.axes = glm::dmat3(2)}, "boxes[0].axes");
  expect_refused("classic", {}, "meets spheres only");
}

TEST(BoxContact, DeepestShare_IsThatOfTheDeepestPlace) {
  for (const BoxCase& c : k_boxes) {
    const RoundedBox& b = c.box;
    const LinkBox<double> box{b.center,  b.radius,      b.axes[0], b.half_size.x,
                              b.axes[1], b.half_size.y, b.axes[2], b.half_size.z};
    const glm::dvec3 from(0.05, 0, 0.01), link(0.1, -0.11, 0.02);
    double most = -1;
    for (int k = 0; k <= 1000; ++k) most = std::max(most, depth_in(b, from + link * (k / 1000.0)));
    EXPECT_NEAR(inside_box(box, from + link * deepest_share(box, from, link)).depth, most, 2e-4) << c.name;
  }
}

}  // namespace
}  // namespace cuticle::sim::boxes_test
