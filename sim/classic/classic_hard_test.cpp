// Cases in which strand solvers are known to break.
#include <cmath>

#include <tbb/global_control.h>

#include "sim/classic/test_strands.h"

namespace cuticle::sim::classic_hard_test {
namespace {

using namespace testing;

TEST(ClassicHard, AnyTimeStep_StaysFiniteWithinReach) {
  const strands::Groom groom = ring(8);
  for (double duration : {1e-3, 1.0 / 60, 0.1, 1.0, 10.0, 100.0})
    for (const std::string& parameters : {std::string(), k_free}) {
      auto solver = make_classic(groom, parameters, gravity());
      const State state = run_still(*solver, 20, duration);
      EXPECT_TRUE(all_finite(state)) << duration;
      EXPECT_EQ(state.guards_fired, 0u) << duration;
      for (const glm::vec3& place : state.positions) EXPECT_LT(glm::length(place), 0.1f + 2 * 0.3f) << duration;
    }
}

TEST(ClassicHard, HeadJumpsHundredMetresWithoutTeleport_StaysFiniteAndComesBack) {
  const strands::Groom groom = ring(8);
  auto solver = make_classic(groom, "", gravity());
  FrameInput input;
  input.head_end = glm::translate(glm::dmat4(1), glm::dvec3(100, 0, 0));
  ASSERT_TRUE(solver->advance(input).ok());
  EXPECT_TRUE(all_finite(*solver->state()));
  input.head_begin = input.head_end;
  for (int k = 0; k < 300; ++k) ASSERT_TRUE(solver->advance(input).ok());
  std::vector<glm::vec3> style;
  for (const glm::vec3& place : groom.positions) style.push_back(place + glm::vec3(100, 0, 0));
  EXPECT_LT(worst_distance(solver->state()->positions, style), 5e-3);
}

TEST(ClassicHard, ZeroLengthSegmentsAndCoincidentVertices_StayFinite) {
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, {0.01, 0, 0.05, 0, 0, 0.05});
  add_straight(groom, {0, 0, 0.1}, {1, 0, 0}, {0, 0, 0});
  add_straight(groom, {0, 0, 0.2}, {1, 0, 0}, {0.05, 0.05, 1e-9});
  for (const std::string& parameters : {std::string(), k_free}) {
    auto solver = make_classic(groom, parameters, gravity());
    const State state = run_frames(*solver, 30);
    EXPECT_TRUE(all_finite(state));
    EXPECT_EQ(state.guards_fired, 0u);
  }
}

TEST(ClassicHard, OneAndTwoVertexStrands_AreLegal) {
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, {});
  add_straight(groom, {0, 0, 0.1}, {1, 0, 0}, {0.05});
  for (const std::string& parameters : {std::string(), k_free}) {
    auto solver = make_classic(groom, parameters, gravity());
    const State state = run_frames(*solver, 30);
    const glm::dvec3 root(frame_of(29).head_end * glm::dvec4(groom.positions[0], 1));
    EXPECT_TRUE(all_finite(state));
    EXPECT_LT(glm::distance(glm::dvec3(state.positions[0]), root), 1e-6);
  }
}

TEST(ClassicHard, StrandThatOverflows_IsResetAndCountedAndTouchesNoOther) {
  const strands::Groom good = ring(4);
  strands::Groom mixed;
  add_straight(mixed, {0, 0, 0}, {1, 0, 0}, {1e25, 1e25, 1e25});  // finite, but its squared lengths are not
  for (std::size_t s = 0; s < good.strand_count(); ++s) {
    mixed.positions.insert(mixed.positions.end(), good.strand(s).begin(), good.strand(s).end());
    mixed.offsets.push_back(static_cast<std::uint32_t>(mixed.positions.size()));
  }
  mixed.radii.assign(mixed.vertex_count(), strands::k_default_radius);
  auto alone = make_classic(good, "", gravity()), beside = make_classic(mixed, "", gravity());
  const State expected = run_frames(*alone, 20), state = run_frames(*beside, 20);
  EXPECT_EQ(state.guards_fired, 1u);
  EXPECT_EQ(state.resets, (std::vector<std::uint32_t>{1, 0, 0, 0, 0}));
  EXPECT_TRUE(all_finite(state));
  for (std::size_t i = 0; i < good.vertex_count(); ++i) {
    EXPECT_EQ(state.positions[i + 4], expected.positions[i]);
    EXPECT_EQ(state.velocities[i + 4], expected.velocities[i]);
  }
}

TEST(ClassicHard, TwoRunsAtOneAndManyThreads_AreBitIdentical) {
  const strands::Groom groom = ring(64);
  const Sphere head{{0, 0, 0}, 0.1};
  std::vector<State> states;
  for (std::size_t threads : {1, 1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    auto solver = make_classic(groom, "", gravity_and_colliders());
    states.push_back(run_frames(*solver, 10, {&head, 1}));
  }
  EXPECT_EQ(states[0].positions, states[1].positions);
  EXPECT_EQ(states[0].positions, states[2].positions);
  EXPECT_EQ(states[0].velocities, states[2].velocities);
}

/// A state in full swing, then one frame whose input `change` edits.
State after_swing(const strands::Groom& groom, const std::function<void(FrameInput&)>& change) {
  auto solver = make_classic(groom, "", {});
  FrameInput input = frame_of(0);
  for (int k = 0; k < 15; ++k) {
    input = frame_of(k);
    EXPECT_TRUE(solver->advance(input).ok());
  }
  input.head_begin = input.head_end;
  change(input);
  EXPECT_TRUE(solver->advance(input).ok());
  return solver->state().value();
}

TEST(ClassicHard, TeleportThenFrame_IsFrameThenRigidMove) {
  const strands::Groom groom = ring(8);
  const glm::dmat4 jump =
      glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(40, -3, 25)), 2.2, glm::normalize(glm::dvec3(1, 2, -1)));
  const State stayed = after_swing(groom, [](FrameInput&) {});
  const State jumped = after_swing(groom, [&](FrameInput& input) {
    input.head_end = jump * input.head_begin;
    input.teleport = true;
  });
  for (std::size_t i = 0; i < groom.vertex_count(); ++i) {
    EXPECT_LT(glm::distance(glm::dvec3(jumped.positions[i]), glm::dvec3(jump * glm::dvec4(stayed.positions[i], 1))),
              2e-5);
    EXPECT_LT(glm::distance(glm::dvec3(jumped.velocities[i]), glm::dmat3(jump) * glm::dvec3(stayed.velocities[i])),
              5e-4);
  }
}

TEST(ClassicHard, FrameOfNoDuration_MovesRigidlyAndKeepsVelocities) {
  const strands::Groom groom = ring(4);
  auto solver = make_classic(groom, "iterations=64", gravity());
  run_frames(*solver, 10);
  const State before = solver->state().value();
  FrameInput input = frame_of(10);
  input.duration = 0;
  input.head_end = glm::translate(glm::dmat4(1), glm::dvec3(1, 2, 3)) * input.head_begin;
  ASSERT_TRUE(solver->advance(input).ok());
  const State after = solver->state().value();
  EXPECT_EQ(after.velocities, before.velocities);
  for (std::size_t i = 0; i < groom.vertex_count(); ++i)
    EXPECT_LT(glm::distance(after.positions[i], before.positions[i] + glm::vec3(1, 2, 3)), 2e-4f);
}

TEST(ClassicHard, FirstFrameFarFromOrigin_StartsInTheRestPoseThere) {
  const strands::Groom groom = ring(4);
  auto solver = make_classic(groom, "", {});
  FrameInput input = frame_of(40, 1.0 / 30, {20, 1, -3});
  input.head_end = input.head_begin;
  ASSERT_TRUE(solver->advance(input).ok());
  const State state = solver->state().value();
  for (std::size_t i = 0; i < groom.vertex_count(); ++i)
    EXPECT_LT(
        glm::distance(glm::dvec3(state.positions[i]), glm::dvec3(input.head_end * glm::dvec4(groom.positions[i], 1))),
        4e-6);
}

TEST(ClassicHard, BadInput_IsRefusedByNameAndChangesNothing) {
  const strands::Groom groom = ring(2);
  auto solver = make_classic(groom, "", gravity());
  run_frames(*solver, 3);
  const State before = solver->state().value();
  const auto message = [&](const std::function<void(FrameInput&)>& change) {
    FrameInput input = frame_of(3);
    change(input);
    const Result<void> result = solver->advance(input);
    return result ? std::string("accepted") : result.error().message;
  };
  const Sphere broken{{NAN, 0, 0}, 1}, negative{{0, 0, 0}, -1};
  EXPECT_THAT(message([](FrameInput& f) { f.duration = 101; }), ::testing::HasSubstr("duration"));
  EXPECT_THAT(message([](FrameInput& f) { f.duration = NAN; }), ::testing::HasSubstr("duration"));
  EXPECT_THAT(message([](FrameInput& f) { f.head_end[3][1] = INFINITY; }), ::testing::HasSubstr("head_end"));
  EXPECT_THAT(message([](FrameInput& f) { f.head_begin *= 2; }), ::testing::HasSubstr("head_begin"));
  EXPECT_THAT(message([&](FrameInput& f) { f.colliders = {&broken, 1}; }), ::testing::HasSubstr("colliders[0]"));
  EXPECT_THAT(message([&](FrameInput& f) { f.colliders = {&negative, 1}; }), ::testing::HasSubstr("colliders[0]"));
  EXPECT_EQ(solver->state()->positions, before.positions);
}

TEST(ClassicHard, EmptyGroom_HasAnEmptyState) {
  auto solver = make_classic(strands::Groom{}, "", gravity());
  EXPECT_TRUE(run_still(*solver, 2, 1.0 / 30).positions.empty());
}

}  // namespace
}  // namespace cuticle::sim::classic_hard_test
