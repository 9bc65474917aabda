// Colliders that move by themselves.
#include <numbers>

#include "sim/chains/test_stability.h"
#include "sim/colliders/distance_field.h"
#include "sim/colliders/test_meshes.h"
#include "sim/head_motion.h"

namespace cuticle::sim::moving_test {
namespace {

using namespace testing;

constexpr double k_frame = 1.0 / 60;
const std::string k_limp = "damping=5,clamped_vertices=1";
std::string limp(std::string_view solver) {
  return k_limp + (solver == "rod" ? ",sag_free=false" : ",shape_stiffness=0");
}

glm::dquat about(const glm::dvec3& axis, double angle) { return glm::angleAxis(angle, axis); }
KeyedMotion straight(const glm::dvec3& from, const glm::dvec3& velocity, double time = 100) {
  return {{{0, {.rotation = {1, 0, 0, 0}, .position = from}},
           {time, {.rotation = {1, 0, 0, 0}, .position = from + velocity * time}}}};
}
/// About the vertical through the origin, from -1 s on.
KeyedMotion turning(double speed) {
  KeyedMotion motion;
  for (int k = -1; k < 40; ++k) motion.keys.push_back({double(k), {.rotation = about({0, 1, 0}, speed * k)}});
  return motion;
}
KeyedMotion jump(double time, const glm::dvec3& from, const glm::dvec3& to) {
  return {{{time, {.position = from}}, {time, {.position = to}}}};
}
RoundedBox plate(const glm::dvec3& center, const glm::dvec3& half) { return {center, glm::dmat3(1), half, 0}; }

/// Frame `k` of a head at rest.
FrameInput frame(int k, std::span<const MovingCollider> moving, double duration = k_frame) {
  return {.duration = duration, .moving = moving, .clock_begin = k * duration, .clock_end = (k + 1) * duration};
}
State run_beside(Solver& solver, int first, int last, std::span<const MovingCollider> moving,
                 double duration = k_frame) {
  for (int k = first; k < last; ++k) EXPECT_TRUE(solver.advance(frame(k, moving, duration)).ok());
  return solver.state().value();
}

TEST(MovingParts, LinearMotionAndConstantTurning_AreExactInEverySubstep) {
  const MovingCollider straight_on{Sphere{}, straight({1, 2, 3}, {4, -5, 6}), false};
  const MovingCollider round{Sphere{}, turning(2), true};
  const MovingCollider* both[] = {&straight_on, &round};
  FrameInput input = frame_of(3);
  input.clock_begin = 0.3;
  input.clock_end = 0.9;
  const HeadWay way(input);
  const std::vector<MovingPart> parts = moving_parts(input, both, 7);
  ASSERT_EQ(parts.size(), 14u);
  for (int k = 0; k < 7; ++k)
    for (int end = 0; end < 2; ++end) {
      const double share = (k + end) / 7.0, time = 0.3 + 0.6 * share;
      const MovingPart &a = parts[2 * k], &b = parts[2 * k + 1];
      const Placement head = way.at(share), line = end ? a.end : a.begin, turn = end ? b.end : b.begin;
      EXPECT_LT(glm::length(line.position + head.position - (glm::dvec3(1, 2, 3) + time * glm::dvec3(4, -5, 6))),
                1e-14);
      const glm::dvec3 x = turn.of({1, 0, 0}),
                       expected = head.rotation * about({0, 1, 0}, 2 * time) * glm::dvec3(1, 0, 0);
      EXPECT_LT(glm::length(x - expected), 1e-14) << k << end;
    }
}

TEST(MovingParts, Jump_IsNoMotionOfItsSubstep) {
  const MovingCollider jumps{Sphere{}, jump(0.45, {0, 0, 0}, {3, 0, 0}), false};
  const MovingCollider* one[] = {&jumps};
  FrameInput input{.duration = 0.4, .clock_begin = 0.3, .clock_end = 0.7};
  const std::vector<MovingPart> parts = moving_parts(input, one, 4);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(parts[k].begin, parts[k].end) << k;
    EXPECT_EQ(parts[k].end.position.x, k > 0 ? 3 : 0) << k;
  }
}

TEST(MovingContact, OnTheHeadWithoutKeys_IsWhatTheHeadTakesAlong) {
  const RoundedBox slab{{0, 0, 0}, glm::mat3_cast(about({0, 1, 0}, 0.4)), {0.07, 0.2, 0.04}, 0.004};
  const FieldPointer ball = std::make_shared<const DistanceField>(*bake_distance_field(
      strands::transformed(ball_mesh(0.08, 16), glm::translate(glm::dmat4(1), glm::dvec3(0.2, -0.06, 0.02))), 0.02,
      "ball"));
  const MovingCollider moving[] = {{slab, {}, true}, {ball, {}, true}};
  for (const char* solver : {"exact", "rod"}) {
    const strands::Groom groom = ring(16);
    auto by_head = make_solver(solver, groom, limp(solver), gravity_and_colliders("friction=0.3")),
         by_itself = make_solver(solver, groom, limp(solver), gravity_and_colliders("friction=0.3"));
    for (int k = 0; k < 5; ++k) {
      FrameInput input = frame_of(k);
      input.moving = moving;
      ASSERT_TRUE(by_itself->advance(input).ok());
      input.moving = {};
      input.boxes = {&slab, 1};
      input.fields = {&ball, 1};
      ASSERT_TRUE(by_head->advance(input).ok());
      const double apart = worst_distance(by_head->state()->positions, by_itself->state()->positions);
      std::printf("%s, slab and ball on the head and by themselves: %.1e m apart after %d frames\n", solver, apart,
                  k + 1);
      EXPECT_LT(apart, k < 3 ? 1.8e-5 : 5e-3) << solver;  // what leaves an overlap parts by rounding
    }
  }
}

/// Largest difference of a velocity from that of the surface over the surface's, of vertices past `first`.
template <class SurfaceVelocity>
double worst_slip(const State& state, std::size_t first, const SurfaceVelocity& surface) {
  double worst = 0;
  for (std::size_t i = first; i < state.positions.size(); ++i) {
    const glm::dvec3 wanted = surface(glm::dvec3(state.positions[i]));
    worst = std::max(worst, glm::distance(glm::dvec3(state.velocities[i]), wanted) / glm::length(wanted));
  }
  return worst;
}

TEST(MovingContact, TurningBox_TakesHairThatLiesOnItAlong) {
  // The strand's root is on the axis, 10 um above the box.
  const FieldPointer mesh = std::make_shared<const DistanceField>(*bake_distance_field(
      strands::transformed(box_mesh({0.5, 0.1, 0.5}), glm::translate(glm::dmat4(1), glm::dvec3(0, -0.1, 0))), 0.05,
      "box"));
  const MovingCollider kinds[] = {{plate({0, -0.1, 0}, {0.5, 0.1, 0.5}), turning(2), false}, {mesh, turning(2), false}};
  for (const MovingCollider& box : kinds)
    for (double friction : {10.0, 0.0}) {
      strands::Groom groom;
      add_straight(groom, {0, 1e-5, 0}, {1, 0, 0}, uniform_segments(20, 0.3));
      auto solver =
          make_exact(groom, k_free, gravity_and_colliders("pearl_radius=0,friction=" + std::to_string(friction)));
      const State state = run_beside(*solver, 0, 60, {&box, 1});
      const double slip =
          worst_slip(state, 2, [](const glm::dvec3& at) { return glm::cross(glm::dvec3(0, 2, 0), at); });
      const double turned = std::atan2(-state.positions.back().z, state.positions.back().x);
      std::printf(
          "strand on a turning %s, friction %.0f: slips by %.1e of the surface's velocity, turned %.3f rad in 1 s\n",
          box.shape.index() == 1 ? "box" : "mesh", friction, slip, turned);
      if (friction > 0) {
        EXPECT_LT(slip, 0.03);
        EXPECT_NEAR(turned, 2, 0.05);
      } else {
        EXPECT_LT(std::abs(turned), 0.01);
      }
    }
}

TEST(MovingContact, MovingPlate_TakesHairThatLiesOnItAlong) {
  const MovingCollider moving{plate({0, -0.1, 0}, {2, 0.1, 2}), straight({0, 0, 0}, {0.5, 0, 0}), false};
  strands::Groom groom;
  add_straight(groom, {0, 1e-5, 0}, {0, 0, 1}, uniform_segments(20, 0.3));
  auto solver = make_exact(groom, k_free, gravity_and_colliders("pearl_radius=0,friction=10"));
  const State state = run_beside(*solver, 0, 3, {&moving, 1});
  double slip = 0;  // across the strand, which its root draws along
  for (std::size_t i = 15; i < state.positions.size(); ++i)
    slip = std::max(slip, std::abs(double(state.velocities[i].x) - 0.5) / 0.5);
  std::printf("strand on a plate at 0.5 m/s: slips by %.1e of it\n", slip);
  EXPECT_LT(slip, 0.03);
}

TEST(MovingContact, AccelerationByFriction_IsCoulombs) {
  const MovingCollider moving{plate({0, -0.1, 0}, {9, 0.1, 9}), straight({0, 0, 0}, {20, 0, 0}), false};
  strands::Groom groom;
  add_straight(groom, {0, 1e-5, 0}, {0, 0, 1}, uniform_segments(20, 0.3));
  auto solver = make_exact(groom, k_free, gravity_and_colliders("pearl_radius=0,friction=0.2"));
  const State state = run_beside(*solver, 0, 3, {&moving, 1});
  EXPECT_NEAR(double(state.velocities.back().x), 0.2 * 9.81 * 3 * k_frame, 0.01 * 9.81 * 3 * k_frame);
}

/// Of what stands in the plate's way and can reach as far as it comes.
double farthest_behind(const State& state, double front) {
  double worst = 0;
  for (std::size_t i = 18; i < state.positions.size(); ++i)
    if (state.positions[i].y < -0.11f) worst = std::max(worst, front - double(state.positions[i].x));
  return worst;
}

TEST(MovingContact, ThinPlateFasterThanItIsThick_IsNotPassed) {
  for (const char* solver : {"exact", "rod"})
    for (double speed : {5.0, 20.0, 40.0, 50.0}) {
      const strands::Groom groom = one(uniform_segments(31, 0.3), {0, -1, 0});
      const MovingCollider moving{plate({0, -0.35, 0}, {0.01, 0.25, 0.5}), straight({-0.16, 0, 0}, {speed, 0, 0}),
                                  false};
      auto made = make_solver(solver, groom, limp(solver), gravity_and_colliders("pearl_radius=0"));
      double behind = 0;
      const double step = 1.0 / 480;
      const int last = int(0.21 / speed / step);
      for (int k = 0; k < last; ++k) {
        const State state = run_beside(*made, k, k + 1, {&moving, 1}, step);
        behind = std::max(behind, farthest_behind(state, -0.15 + speed * step * (k + 1)));
        EXPECT_LE(worst_over_bound(groom, state), 1);
      }
      std::printf("%s, plate of 2 cm at %.0f m/s: farthest behind its front %.1e m\n", solver, speed, behind);
      if (speed < 50) {  // hair above the plate holds back what is moved by more than ten links at once
        EXPECT_LT(behind, 1e-3) << solver << speed;
      }
    }
}

TEST(MovingContact, FiftyMetresPerSecondThroughHair_NeitherStretchesNorExplodes) {
  const FieldPointer ball =
      std::make_shared<const DistanceField>(*bake_distance_field(ball_mesh(0.1, 16), 0.02, "ball"));
  KeyedMotion to_and_fro;
  for (int k = 0; k < 60; ++k)
    to_and_fro.keys.push_back({k * 0.04, {about({0.6, 0.8, 0}, 2.0 * k), {k % 2 ? 1.0 : -1.0, 0.05, 0.03}}});
  const MovingCollider kinds[] = {{Sphere{{0, 0, 0}, 0.1}, to_and_fro, false},
                                  {make_capsule({0, 0, -0.3}, {0, 0, 0.3}, 0.02), to_and_fro, false},
                                  {plate({0, 0, 0}, {0.01, 0.4, 0.4}), to_and_fro, true},
                                  {ball, to_and_fro, false}};
  for (const char* solver : {"exact", "rod", "classic"})
    for (const MovingCollider& kind : kinds) {
      if (solver == std::string("classic") && !std::holds_alternative<Sphere>(kind.shape)) continue;
      const strands::Groom groom = ring(8);
      auto made = make_solver(solver, groom, solver == std::string("classic") ? "damping=5" : limp(solver),
                              gravity_and_colliders("friction=0.5"));
      double stretch = 0;
      for (int k = 0; k < 120; ++k) {
        const State state = run_beside(*made, k, k + 1, {&kind, 1});
        ASSERT_TRUE(all_finite(state)) << solver << kind.shape.index();
        EXPECT_EQ(state.guards_fired, 0u);
        stretch = std::max(stretch, worst_over_bound(groom, state));
      }
      const double later = fastest(run_beside(*made, 600, 1200, {}));
      std::printf("%s, shape %zu at 50 m/s: stretch over bound %.2f, fastest 10 s later %.2f m/s\n", solver,
                  kind.shape.index(), stretch, later);
      if (solver != std::string("classic")) {
        EXPECT_LE(stretch, 1) << solver << kind.shape.index();
      }
      EXPECT_LT(later, 3.5) << solver;
    }
}

TEST(MovingContact, Jump_PushesOutWithoutVelocity) {
  // From far below to 5 mm over a strand that lies on a plate at rest.
  const RoundedBox box = plate({0, -0.1, 0}, {2, 0.1, 2});
  for (double up : {0.0, 0.005}) {
    strands::Groom groom;
    add_straight(groom, {0, 0.01, 0}, {1, 0, 0}, uniform_segments(20, 0.3));
    auto solver = make_exact(groom, k_free, gravity_and_colliders("pearl_radius=0"));
    const MovingCollider moving{box, jump(1, {0, 0, 0}, {0, up, 0}), false};
    run_beside(*solver, 0, 59, {&moving, 1});
    const double before = fastest(*solver->state());
    double most = 0;
    for (int k = 59; k < 62; ++k) most = std::max(most, fastest(run_beside(*solver, k, k + 1, {&moving, 1})));
    std::printf("plate that jumps by %.3f m: fastest vertex %.2e m/s before, %.2e after\n", up, before, most);
    EXPECT_LT(most, before + 0.25) << up;
    const State state = *solver->state();
    for (std::size_t i = 2; i < state.positions.size(); ++i) EXPECT_GT(double(state.positions[i].y), up - 1e-4);
  }
}

TEST(MovingContact, SphereOfClassic_PushesAtItsSpeed) {
  const strands::Groom groom = one(uniform_segments(16, 0.3), {0, -1, 0});
  const MovingCollider moving{Sphere{{0, -0.3, 0}, 0.1}, straight({-0.2, 0, 0}, {1, 0, 0}), false};
  auto solver = make_classic(groom, "clamped_vertices=1,shape_stiffness=0", gravity_and_colliders());
  const State state = run_beside(*solver, 0, 15, {&moving, 1});
  const glm::dvec3 centre(0.05, -0.3, 0);
  double nearest = 1;
  for (const glm::vec3& place : state.positions) nearest = std::min(nearest, glm::distance(centre, glm::dvec3(place)));
  EXPECT_GT(nearest, 0.1 - 1e-4);
  EXPECT_GT(state.positions.back().x, 0.05f);
  EXPECT_NEAR(double(state.velocities.back().x), 1, 0.35);
}

void expect_refused(std::string_view solver, FrameInput input, std::string_view why) {
  const auto result = make_solver(solver, ring(1), "", gravity_and_colliders())->advance(input);
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, ::testing::HasSubstr(std::string(why)));
}
TEST(MovingContact, WhatIsNoMovingCollider_IsRefusedByName) {
  const MovingCollider box{RoundedBox{}, {}, false}, negative{Sphere{{0, 0, 0}, -1}, {}, false},
      null{FieldPointer{}, {}, false}, back{Sphere{}, {{{1, {}}, {0, {}}}}, false};
  expect_refused("classic", {.moving = {&box, 1}}, "moving: the solver meets spheres only");
  expect_refused("exact", {.moving = {&negative, 1}}, "moving[0]: centre (0, 0, 0), radius -1");
  expect_refused("rod", {.moving = {&null, 1}}, "moving[0]: null");
  expect_refused("exact", {.moving = {&back, 1}}, "moving[0].keys[1]: time 0 s is before");
  expect_refused("exact", {.clock_begin = 1, .clock_end = 0}, "clock_begin");
}

}  // namespace
}  // namespace cuticle::sim::moving_test
