// Chains of rigid links on a skin: roots, lengths, root frames, teleports, and what is refused.
#include "sim/chains/test_stability.h"

namespace cuticle::sim::on_skin_test {
namespace {

using namespace testing;

class OnSkin : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, OnSkin, ::testing::Values("exact", "rod"),
                         [](const auto& info) { return info.param; });

TEST_P(OnSkin, SkinThatMovesAsAHead_MovesHairAsTheHeadDoes) {
  const strands::Groom groom = ring(6);
  auto on_head = make_solver(GetParam(), groom, "", {}), on_skin = make_solver(GetParam(), groom, "", {});
  const auto shift = [](int frame) { return glm::dvec3(0.01 * frame, 0.02 * std::sin(0.3 * frame), -0.005 * frame); };
  for (int frame = 0; frame <= 20; ++frame) {
    FrameInput input{.duration = frame > 0 ? 1.0 / 30 : 0};
    input.head_begin = glm::translate(glm::dmat4(1), shift(std::max(0, frame - 1)));
    input.head_end = glm::translate(glm::dmat4(1), shift(frame));
    ASSERT_TRUE(on_head->advance(input).ok());
    std::vector<glm::vec3> skinned = groom.positions;
    for (glm::vec3& place : skinned) place += glm::vec3(shift(frame));
    advance_on(*on_skin, skinned, input.duration);
  }
  const State a = on_head->state().value(), b = on_skin->state().value();
  const double places = worst_distance(a.positions, b.positions), speeds = worst_distance(a.velocities, b.velocities);
  std::printf("%s: on a skin and on a head that move alike %.1e m, %.1e m/s apart\n", GetParam(), places, speeds);
  EXPECT_LT(places, 3e-5);
  EXPECT_LT(speeds, 1e-3);
}

TEST_P(OnSkin, SkinThatDeforms_StaysRootedAtItsLength) {
  const strands::Groom groom = ring(12);
  auto solver = make_solver(GetParam(), groom, "", gravity());
  double root = 0, stretched = 0, lag = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const std::vector<glm::vec3> skinned = on_turning_roots(groom, frame / 30.0);
    advance_on(*solver, skinned);
    const State state = solver->state().value();
    EXPECT_EQ(state.guards_fired, 0u);
    for (std::size_t s = 0; s < groom.strand_count(); ++s) {
      root = std::max(root, double(glm::distance(state.positions[groom.offsets[s]], skinned[groom.offsets[s]])));
      const std::size_t tip = groom.offsets[s + 1] - 1;
      lag = std::max(lag, double(glm::distance(state.positions[tip], skinned[tip])));
    }
    stretched = std::max(stretched, worst_stretch(groom, state));
  }
  std::printf("%s on a skin: roots off by %.1e m, stretch %.1e, tips up to %.3f m behind\n", GetParam(), root,
              stretched, lag);
  EXPECT_EQ(root, 0);
  EXPECT_LT(stretched, 1e-5);
  EXPECT_GT(lag, 0.05);
}

TEST_P(OnSkin, RestShape_TurnsWithTheFrameOfTheRoot) {
  const strands::Groom groom = curls();
  auto solver = make_solver(GetParam(), groom, "", {});
  std::vector<glm::vec3> skinned;
  for (int frame = 0; frame <= 360; ++frame) {
    skinned.clear();
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 0.03 * std::min(frame, 60), glm::dvec3(0.1, 1, 0.2)));
    for (std::size_t i = 0; i < groom.vertex_count(); ++i) {
      const glm::dvec3 root(groom.positions[i - i % 17]);
      skinned.emplace_back(root + turn * (glm::dvec3(groom.positions[i]) - root));
    }
    advance_on(*solver, skinned);
  }
  const double away = worst_distance(solver->state()->positions, skinned);
  std::printf("%s: curls on roots that turned by 1.8 radians come to rest %.1e m from their shape\n", GetParam(), away);
  EXPECT_LT(away, 1e-4);
}

TEST_P(OnSkin, Teleport_PutsHairOntoItAtRest) {
  const strands::Groom groom = ring(6);
  auto solver = make_solver(GetParam(), groom, "", {});
  const OffSkin off = after_teleport_of_skin(*solver, groom);
  EXPECT_LT(off.places, 2e-6);
  EXPECT_LT(off.speeds, 1e-3);
}

TEST_P(OnSkin, HairPutOntoIt_MovesOnAsHairThatIsNew) {
  const strands::Groom groom = curls();
  for (const FrameInput& onto : {FrameInput{.duration = 1.0 / 30, .teleport = true}, FrameInput{.duration = 0}}) {
    auto moved = make_solver(GetParam(), groom, "", gravity()), made = make_solver(GetParam(), groom, "", gravity());
    for (int frame = 0; frame < 20; ++frame) advance_on(*moved, on_turning_roots(groom, frame / 30.0));
    for (int frame = 0; frame < 4; ++frame) {
      const std::vector<glm::vec3> skinned = on_turning_roots(groom, 3 + frame / 30.0);
      FrameInput input = frame > 0 ? FrameInput{.duration = 1.0 / 30} : onto;
      input.skinned = skinned;
      ASSERT_TRUE(moved->advance(input).ok() && made->advance(input).ok());
      EXPECT_EQ(moved->state()->positions, made->state()->positions) << frame << " after " << onto.duration << " s";
    }
  }
}

TEST_P(OnSkin, EveryShapeStepAndDisturbance_KeepsItsLengths) {
  for (const char* precision : {"", ",double_precision=true"})
    expect_lengths(GetParam(), {std::string("damping=2") + precision, std::string("clamped_vertices=1") + precision},
                   12, true);
}

TEST_P(OnSkin, StrandWhoseSquaresOverflow_TouchesNoOther) {
  const strands::Groom good = ring(20), mixed = beside_overflow(good);
  auto alone = make_solver(GetParam(), good, "", gravity()), beside = make_solver(GetParam(), mixed, "", gravity());
  for (int frame = 0; frame < 20; ++frame) {
    std::vector<glm::vec3> skinned = on_turning_roots(good, frame / 30.0);
    advance_on(*alone, skinned);
    skinned.insert(skinned.begin(), mixed.positions.begin(), mixed.positions.begin() + 17);
    advance_on(*beside, skinned);
  }
  const State expected = alone->state().value(), state = beside->state().value();
  EXPECT_TRUE(all_finite(state));
  for (std::size_t i = 0; i < good.vertex_count(); ++i) ASSERT_EQ(state.positions[i + 17], expected.positions[i]);
}

TEST_P(OnSkin, WhatItCannotHave_IsRefused) {
  const strands::Groom groom = ring(2);
  std::vector<glm::vec3> skinned = groom.positions;
  auto solver = make_solver(GetParam(), groom, "", gravity_and_colliders());
  advance_on(*solver, skinned);
  EXPECT_FALSE(solver->advance({}).ok());
  skinned[3].y = NAN;
  EXPECT_THAT(solver->advance({.skinned = skinned}).error().message, ::testing::HasSubstr("skinned[3]"));
  skinned.pop_back();
  EXPECT_FALSE(solver->advance({.skinned = skinned}).ok());
}

}  // namespace
}  // namespace cuticle::sim::on_skin_test
