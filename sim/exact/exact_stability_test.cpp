// Cases in which strand solvers are known to break: lengths hold, nothing is lost, at any time step, in float and
// double.
#include <tbb/global_control.h>

#include "sim/chains/guard.h"
#include "sim/chains/test_stability.h"
#include "sim/exact/exact.h"
#include "sim/exact/kernel.h"

namespace cuticle::sim::exact_stability_test {
namespace {

using namespace testing;

class ExactStability : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Precisions, ExactStability, ::testing::Values(false, true),
                         [](const auto& info) { return info.param ? "Double" : "Float"; });

TEST_P(ExactStability, EveryShapeStepAndDisturbance_KeepsItsLengths) {
  const std::string precision = GetParam() ? ",double_precision=true" : "";
  expect_lengths("exact", {k_free + precision, "clamped_vertices=1" + precision}, 60);
}

TEST_P(ExactStability, AfterTheDisturbance_EnergyFallsAgain) {
  const strands::Groom groom = one(uniform_segments(31, 0.3));
  for (double duration : {1.0 / 480, 1.0 / 60, 0.1}) {
    auto solver = make_exact(groom, settings(k_free + (GetParam() ? ",double_precision=true" : "")), gravity());
    FrameInput input{
        .duration = duration, .head_end = glm::translate(glm::dmat4(1), glm::dvec3(100, 0, 0)), .colliders = {}};
    ASSERT_TRUE(solver->advance(input).ok());
    input.head_begin = input.head_end;
    for (int k = 0; k < 30; ++k) ASSERT_TRUE(solver->advance(input).ok());
    const double early = fastest(*solver->state());
    for (int k = 0; k < 2000; ++k) ASSERT_TRUE(solver->advance(input).ok());
    const double late = fastest(*solver->state());
    std::printf("after a jump of 100 m, steps of %.4f s: fastest vertex %.3g m/s after 30 steps, %.3g m/s after 2030\n",
                duration, early, late);
    EXPECT_LT(late, early);
    EXPECT_LT(late, 20);
  }
}

TEST(ExactHard, FoldAlongGravity_Opens) {
  for (const glm::dvec3& direction : {glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)}) {
    auto solver = make_exact(folded(direction), "damping=2,shape_stiffness=0,clamped_vertices=1", gravity());
    const State state = run_still(*solver, 300, 1.0 / 60);
    EXPECT_LT(state.positions.back().y, -0.3f) << direction.x << direction.z;  // 31 links of 10 mm hang down
  }
}

TEST(ExactHard, LaneThatIsNotANumber_IsResetAndTouchesNoOther) {
  const chains::ChainSettings parameters = exact::make_settings(settings_of("exact"), gravity());
  chains::Chains<float> good = chains::make_chains<float>(ring(16), parameters), broken = good;
  broken.state_at(0, 2, chains::state_row::velocity)[3] = NAN;
  Substep part;
  part.duration = 1.f / 480;
  chains::ChainClock clock;
  const auto steps = clock.steps<float>(parameters, {&part, 1});
  std::vector<float> scratch(std::size_t(good.longest + 2) * chains::scratch_row::count * chains::k_lanes, 0.f),
      other = scratch;
  const chains::ChainFrame<float> frame{steps.data(), 1, nullptr, 0, nullptr, 0, nullptr};
  exact::best_kernels().advance[1][0](good.block(0, scratch.data()), frame);
  exact::best_kernels().advance[1][0](broken.block(0, other.data()), frame);
  chains::Placing placing;
  placing.advance({&part, 1});
  chains::reset_broken_lanes<float>(broken, 0, [&](std::size_t) { return placing; });
  for (std::size_t lane = 0; lane < std::size_t(chains::k_lanes); ++lane) {
    EXPECT_EQ(broken.strand_at(0, chains::strand_row::guarded)[lane] == float(chains::k_was_reset), lane == 3);
    for (std::size_t k = lane; k < broken.state.size(); k += chains::k_lanes) {
      EXPECT_TRUE(std::isfinite(broken.state[k]));
      if (lane != 3) {
        EXPECT_EQ(broken.state[k], good.state[k]);
      }
    }
  }
}

TEST(ExactHard, StrandWhoseSquaresOverflow_KeepsItsLengthsAndTouchesNoOther) {
  const strands::Groom good = ring(20), mixed = beside_overflow(good);
  const Sphere head{{0, 0, 0}, 0.095};
  auto alone = make_exact(good, "", gravity_and_colliders()), beside = make_exact(mixed, "", gravity_and_colliders());
  const State expected = run_frames(*alone, 20, {&head, 1}), state = run_frames(*beside, 20, {&head, 1});
  EXPECT_TRUE(all_finite(state));
  EXPECT_NEAR(glm::distance(glm::dvec3(state.positions[5]), glm::dvec3(state.positions[4])), 1e25, 1e20);
  for (std::size_t i = 0; i < good.vertex_count(); ++i) {
    ASSERT_EQ(state.positions[i + 17], expected.positions[i]);
    ASSERT_EQ(state.velocities[i + 17], expected.velocities[i]);
  }
}

TEST(ExactHard, TwoRunsAtOneAndManyThreads_AreBitIdentical) {
  const strands::Groom groom = ring(200);
  auto many = make_exact(groom, "", gravity()), single = make_exact(groom, "", gravity());
  const State a = run_frames(*many, 10);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const State b = run_frames(*single, 10);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.velocities, b.velocities);
}

TEST(ExactHard, ManyDifferentStrands_AreWhatEachIsAlone) {
  strands::Groom all;
  for (int s = 0; s < 40; ++s) add_straight(all, {0.01 * s, 0, 0}, {0, 0, 1}, uniform_segments(s % 7, 0.05 * (s % 5)));
  auto together = make_exact(all, "", gravity());
  const State state = run_frames(*together, 10);
  for (std::size_t s = 0; s < all.strand_count(); s += 6) {
    strands::Groom alone;
    alone.positions.assign(all.strand(s).begin(), all.strand(s).end());
    alone.radii.assign(alone.positions.size(), strands::k_default_radius);
    alone.offsets = {0, std::uint32_t(alone.positions.size())};
    auto solver = make_exact(alone, "", gravity());
    const State own = run_frames(*solver, 10);
    for (std::size_t i = 0; i < own.positions.size(); ++i)
      EXPECT_EQ(own.positions[i], state.positions[all.offsets[s] + i]) << s;
  }
}

TEST(ExactHard, HundredMetresFromOrigin_MovesAsAtTheOrigin) {
  const strands::Groom groom = ring(4);
  auto here = make_exact(groom, "", gravity()), far = make_exact(groom, "", gravity());
  const glm::dvec3 origin(100, -50, 70);
  State a = run_frames(*here, 30), b = run_frames(*far, 30, {}, origin);
  for (glm::vec3& place : b.positions) place -= glm::vec3(origin);
  EXPECT_LT(worst_distance(a.positions, b.positions), 4e-5);  // the world position itself rounds to 4e-6
}

TEST(ExactHard, FrameWithoutDuration_CarriesTheStateRigidly) {
  const strands::Groom groom = ring(8);
  auto solver = make_exact(groom, "", gravity());
  const State before = run_frames(*solver, 5);
  const glm::dmat4 head = frame_of(4).head_end, move = glm::translate(glm::dmat4(1), glm::dvec3(1, 2, 3));
  ASSERT_TRUE(solver->advance({.duration = 0, .head_begin = head, .head_end = move * head, .colliders = {}}).ok());
  const State after = solver->state().value();
  for (std::size_t i = 0; i < groom.vertex_count(); ++i)
    EXPECT_LT(glm::distance(after.positions[i], before.positions[i] + glm::vec3(1, 2, 3)), 2e-6f);
  EXPECT_EQ(after.velocities, before.velocities);
}

TEST(ExactHard, InputOutOfRange_IsRefusedAndTheStateKept) {
  const strands::Groom groom = ring(4);
  auto solver = make_exact(groom, "", gravity());
  const State before = run_frames(*solver, 3);
  FrameInput input;
  input.duration = 101;
  EXPECT_FALSE(solver->advance(input).ok());
  EXPECT_EQ(solver->state()->positions, before.positions);
}

TEST(ExactHard, EmptyGroom_HasAnEmptyState) {
  auto solver = make_exact(strands::Groom{}, "", gravity());
  EXPECT_TRUE(run_still(*solver, 2, 1.0 / 30).positions.empty());
}

TEST(ClassicEffects, WhatItDoesNotKnow_IsRefusedByName) {
  const auto made =
      (*find_effect("classic"))->create(ring(1), settings_of("classic"), {{"cloth", settings_of("cloth")}});
  ASSERT_FALSE(made.ok());
  EXPECT_THAT(made.error().message, ::testing::HasSubstr("cloth"));
}

TEST(ExactContact, StrandsOnBalls_KeepLengthStayOutsideAndComeToRest) {
  for (const BallCase& ball : k_balls) {
    const Rest rest = rest_on(ball, "exact", "damping=5,shape_stiffness=0,clamped_vertices=1");
    std::printf("%-30s stretch over bound %.2f, deepest segment %.1e r, tip after 5 s %.1e m/s\n", ball.name,
                rest.stretch, rest.depth, rest.tip_speed);
    EXPECT_LE(rest.stretch, 1) << ball.name;
    EXPECT_LT(rest.depth, 5e-7) << ball.name;
    EXPECT_LT(rest.tip_speed, ball.resting) << ball.name;
  }
}

TEST(ExactContact, SphereThatEngulfsTheRoot_LengthWins) {
  for (double radius : {0.15, 0.3, 5.0}) {
    const strands::Groom groom = ring(8);
    const Sphere ball{{0, 0, 0}, radius};
    auto solver = make_exact(groom, "", gravity_and_colliders());
    const State state = run_still(*solver, 60, 1.0 / 30, {&ball, 1});
    EXPECT_TRUE(all_finite(state)) << radius;
    EXPECT_LT(worst_stretch(groom, state), 1e-4) << radius;  // 0.1 m from the origin the state itself rounds to 4e-9 m
  }
}

TEST(ExactContact, Incline_SticksBelowAndSlidesAboveTheAngleOfFriction) {
  // A strand lies across a ball so large that it is a plane, falling off at 20 degrees; tan 20 deg = 0.364.
  const double slope = 20 * 3.14159265358979 / 180, radius = 100;
  const glm::dvec3 normal(std::sin(slope), std::cos(slope), 0);
  const Sphere plane{-radius * normal, radius};
  for (double friction : {0.25, 0.5}) {
    strands::Groom groom;
    add_straight(groom, 1e-5 * normal, {0, 0, 1}, uniform_segments(20, 0.2));
    auto solver = make_exact(groom, "damping=0,shape_stiffness=0,clamped_vertices=1",
                             gravity_and_colliders("pearl_radius=0,friction=" + std::to_string(friction)));
    const State state = run_still(*solver, 60, 1.0 / 60, {&plane, 1});
    const double moved = worst_distance(state.positions, groom.positions);
    std::printf("incline of 20 deg, friction %.2f: moved %.4f m in 1 s\n", friction, moved);
    if (friction > 0.364)
      EXPECT_LT(moved, 1e-3);
    else
      EXPECT_GT(moved, 0.05);
  }
}

}  // namespace
}  // namespace cuticle::sim::exact_stability_test
