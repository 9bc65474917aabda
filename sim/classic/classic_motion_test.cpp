// The CPU solver against truths of mechanics.
#include <cmath>

#include "sim/classic/test_strands.h"
#include "sim/rest_pose.h"

namespace cuticle::sim::classic_motion_test {
namespace {

using namespace testing;

strands::Groom one_strand(const std::vector<double>& segments, glm::dvec3 direction = {1, 0, 0}) {
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, direction, segments);
  return groom;
}

double agm(double a, double b) {
  while (std::abs(a - b) > 1e-15 * a) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return a;
}

/// Mean period over two swings, from crossings of the vertical.
double measured_period(Solver& solver, double step) {
  FrameInput input;
  input.duration = step;
  std::vector<double> crossings;
  double previous = 1;
  for (int k = 1; crossings.size() < 5 && k < 100000; ++k) {
    EXPECT_TRUE(solver.advance(input).ok());
    const double x = double(solver.state()->positions[1].x);
    if (previous * x < 0) crossings.push_back(step * (k - std::abs(x) / (std::abs(x) + std::abs(previous))));
    previous = x;
  }
  return (crossings.back() - crossings.front()) / 2;
}

TEST(ClassicMotion, Pendulum_PeriodIsThatOfTheArithmeticGeometricMean) {
  const double length = 0.2, amplitude = 3.14159265358979 / 2, step = 1.0 / 240;
  const double truth = 2 * 3.14159265358979 * std::sqrt(length / 9.80665) / agm(1, std::cos(amplitude / 2));
  const strands::Groom groom = one_strand({length});
  auto solver = make_classic(groom, k_free, gravity());
  const double period = measured_period(*solver, step);
  RecordProperty("relative_error", std::to_string(period / truth - 1));
  EXPECT_NEAR(period / truth, 1, 3e-4);
}

TEST(ClassicMotion, HangingChain_ComesToRestStraightAndUnstretched) {
  for (const auto& segments : {uniform_segments(32, 0.3), growing_segments(31, 0.3, 8), growing_segments(6, 0.3, 8)}) {
    const strands::Groom groom = one_strand(segments);
    auto solver = make_classic(groom, "damping=5,shape_stiffness=0,clamped_vertices=1", gravity());
    const State state = run_still(*solver, 300, 1.0 / 30);
    EXPECT_LT(glm::distance(glm::dvec3(state.positions.back()), glm::dvec3(0, -0.3, 0)), 1e-4) << segments.size();
    EXPECT_LT(worst_stretch(groom, state), 1e-4) << segments.size();
  }
}

/// Worst stretch while a horizontal strand falls and swings for a second.
double swing_stretch(const std::vector<double>& segments, int iterations, const std::string& settings = {}) {
  const strands::Groom groom = one_strand(segments);
  auto solver =
      make_classic(groom, k_free + ",damping=2,iterations=" + std::to_string(iterations) + settings, gravity());
  double worst = 0;
  for (int frame = 0; frame < 30; ++frame)
    worst = std::max(worst, worst_stretch(groom, run_still(*solver, 1, 1.0 / 30)));
  return worst;
}

TEST(ClassicMotion, MoreIterations_StretchLess) {
  double previous = 10;
  for (int iterations : {1, 4, 16}) {
    const double worst = swing_stretch(uniform_segments(16, 0.3), iterations);
    std::printf("16 uniform segments, %d iterations: worst stretch %.4f\n", iterations, worst);
    EXPECT_LT(worst, previous);
    previous = worst;
  }
  EXPECT_LT(previous, 0.02);
}

TEST(ClassicMotion, RedBlackOrder_ConvergesAsTheSequenceDoes) {
  double previous = 10;
  for (int iterations : {4, 16, 64}) {
    const double worst = swing_stretch(uniform_segments(16, 0.3), iterations, ",order=red_black");
    std::printf("red and black, %d iterations: worst stretch %.4f\n", iterations, worst);
    EXPECT_LT(worst, previous);
    previous = worst;
  }
  EXPECT_LT(previous, 0.0035);
}

/// Farthest that a vertex of a falling strand gets from its root over the arc between them.
double farthest_over_reach(const std::string& settings) {
  const std::vector<double> segments = uniform_segments(16, 0.3);
  const strands::Groom groom = one_strand(segments);
  auto solver = make_classic(groom, k_free + ",iterations=1," + settings, gravity());
  double worst = 0;
  for (int frame = 0; frame < 30; ++frame) {
    const State state = run_still(*solver, 1, 1.0 / 30);
    for (std::size_t i = 1; i < groom.vertex_count(); ++i)
      worst = std::max(worst, double(glm::distance(state.positions[i], state.positions[0])) / (0.3 * double(i) / 16));
  }
  return worst;
}

TEST(ClassicMotion, LongRangeAttachments_HoldTheReachThatOneSweepLoses) {
  for (const std::string order : {"sequence", "red_black"}) {
    const double free = farthest_over_reach("long_range=false,order=" + order),
                 held = farthest_over_reach("order=" + order);
    std::printf("%s, one sweep: farthest over the reach %.4f, with long range attachments %.4f\n", order.c_str(), free,
                held);
    EXPECT_GT(free, 1.5);
    EXPECT_LT(held, 1.06);
  }
}

TEST(ClassicMotion, SphereAroundTheTarget_HoldsEveryVertexWithinItsRadius) {
  const strands::Groom groom = ring(8);
  for (const std::string order : {"sequence", "red_black"}) {
    auto solver = make_classic(groom, k_free + ",sphere_root=0.005,sphere_tip=0.05,order=" + order, gravity());
    const RestPose pose = make_rest_pose(groom, 1);
    double worst = 0, tip = 0;
    for (int frame = 0; frame < 60; ++frame) {
      const FrameInput input = frame_of(frame);
      ASSERT_TRUE(solver->advance(input).ok());
      const State state = solver->state().value();
      for (std::size_t i = 0; i < groom.vertex_count(); ++i) {
        const glm::dvec3 target(input.head_end * glm::dvec4(groom.positions[i], 1));
        const double radius = 0.005 + 0.045 * double(pose.traits[i].y),
                     away = glm::distance(glm::dvec3(state.positions[i]), target);
        worst = std::max(worst, away - radius);
        tip = std::max(tip, away);
      }
    }
    std::printf("%s: farthest past the sphere %.2e m, farthest from the target %.4f m\n", order.c_str(), worst, tip);
    EXPECT_LT(worst, 1e-6);
    EXPECT_GT(tip, 0.045);
  }
}

TEST(ClassicMotion, SevenVerticesGrowingOneToEight_StretchIsBounded) {
  const double worst = swing_stretch(growing_segments(6, 0.3, 8), 4);
  std::printf("6 segments growing 1:8, 4 iterations: worst stretch %.4f\n", worst);
  EXPECT_LT(worst, 0.05);
}

TEST(ClassicMotion, FallingHead_LeavesItsHairInShape) {
  // Root and hair fall alike, so nothing pulls; one substep a frame keeps the head's path that of free fall.
  const strands::Groom groom = one_strand(growing_segments(8, 0.3, 8), {0.6, 0.8, 0});
  auto solver = make_classic(groom, k_free + ",inner_step=1", gravity());
  const double h = 1.0 / 60;
  const auto fallen = [&](int k) {
    return glm::translate(glm::dmat4(1), glm::dvec3(0, -0.5 * 9.80665 * h * h * k * k, 0));
  };
  FrameInput input;
  input.duration = h;
  for (int k = 0; k < 30; ++k) {
    input.head_begin = fallen(k);
    input.head_end = fallen(k + 1);
    ASSERT_TRUE(solver->advance(input).ok());
  }
  const State state = solver->state().value();
  const glm::vec3 drop(0, -0.5 * 9.80665 * 0.25, 0);
  for (std::size_t i = 0; i < groom.vertex_count(); ++i)
    EXPECT_LT(glm::distance(state.positions[i], groom.positions[i] + drop), 2e-6f) << i;
}

TEST(ClassicMotion, HeadAtRest_SagFreeGroomStaysAsCombed) {
  const strands::Groom groom = ring(8);
  auto solver = make_classic(groom, "", gravity());
  EXPECT_LT(worst_distance(run_still(*solver, 60, 1.0 / 30).positions, groom.positions), 5e-4);
}

TEST(ClassicMotion, TurningHead_HairLagsAndComesBackToStyle) {
  const strands::Groom groom = ring(8);
  auto solver = make_classic(groom, "", gravity());
  FrameInput input;
  input.head_end = glm::rotate(glm::dmat4(1), 1.0, glm::dvec3(0, 1, 0));
  const auto away_from_style = [&] {
    std::vector<glm::vec3> style;
    for (const glm::vec3& place : groom.positions) style.emplace_back(input.head_end * glm::dvec4(place, 1));
    return worst_distance(solver->state()->positions, style);
  };
  ASSERT_TRUE(solver->advance(input).ok());
  EXPECT_GT(away_from_style(), 0.05);
  input.head_begin = input.head_end;
  for (int k = 0; k < 180; ++k) ASSERT_TRUE(solver->advance(input).ok());
  EXPECT_LT(away_from_style(), 2e-3);
}

TEST(ClassicMotion, ClampedVertices_FollowTheHeadExactly) {
  const strands::Groom groom = ring(4);
  auto solver = make_classic(groom, "", gravity());
  const State state = run_frames(*solver, 10);
  const glm::dmat4 head = frame_of(9).head_end;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t i : {groom.offsets[s], groom.offsets[s] + 1})
      EXPECT_LT(glm::distance(glm::dvec3(state.positions[i]), glm::dvec3(head * glm::dvec4(groom.positions[i], 1))),
                2e-7);
}

TEST(ClassicMotion, HundredMetresFromOrigin_MovesAsAtTheOrigin) {
  const strands::Groom groom = ring(4);
  auto here = make_classic(groom, "", gravity()), far = make_classic(groom, "", gravity());
  const glm::dvec3 origin(100, -50, 70);
  State a = run_frames(*here, 30), b = run_frames(*far, 30, {}, origin);
  for (glm::vec3& place : b.positions) place -= glm::vec3(origin);
  EXPECT_LT(worst_distance(a.positions, b.positions), 4e-5);  // the world position itself rounds to 4e-6
}

/// Advances on a skin that has these places at the frame's end.
TEST(ClassicMotion, SkinThatMovesAsAHead_MovesHairAsTheHeadDoes) {
  const strands::Groom groom = ring(6);
  auto on_head = make_classic(groom, "", gravity()), on_skin = make_classic(groom, "", gravity());
  const auto shift = [](int frame) { return glm::dvec3(0.02 * frame, 0.03 * std::sin(frame), -0.01 * frame); };
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
  // A skin's places are of the world, and the weak pull at the tips amplifies their rounding.
  EXPECT_LT(worst_distance(a.positions, b.positions), 1.5e-4);
  EXPECT_LT(worst_distance(a.velocities, b.velocities), 1.2e-3);
}

TEST(ClassicMotion, HairOnASkinThatDeforms_StaysRootedAtItsLength) {
  const strands::Groom groom = ring(12);
  auto solver = make_classic(groom, "iterations=16", gravity());
  double root = 0, stretched = 0, lag = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const std::vector<glm::vec3> skinned = on_turning_roots(groom, frame / 30.0);
    advance_on(*solver, skinned);
    const State state = solver->state().value();
    for (std::size_t s = 0; s < groom.strand_count(); ++s) {
      root = std::max(root, double(glm::distance(state.positions[groom.offsets[s]], skinned[groom.offsets[s]])));
      const std::size_t tip = groom.offsets[s + 1] - 1;
      lag = std::max(lag, double(glm::distance(state.positions[tip], skinned[tip])));
    }
    stretched = std::max(stretched, worst_stretch(groom, state));
  }
  std::printf("on a skin: roots off by %.1e m, stretch %.1e, tips up to %.3f m behind\n", root, stretched, lag);
  EXPECT_LT(root, 1e-7);
  EXPECT_LT(stretched, 6.5e-3);
  EXPECT_GT(lag, 0.05);
}

TEST(ClassicMotion, SkinAtRest_HoldsTheGroomAgainstGravity) {
  const strands::Groom groom = ring(12);
  auto solver = make_classic(groom, "", gravity());
  const std::vector<glm::vec3> skinned = on_turning_roots(groom, 0.4);
  for (int frame = 0; frame < 60; ++frame) advance_on(*solver, skinned);
  EXPECT_LT(worst_distance(solver->state()->positions, skinned), 4e-5);
}

TEST(ClassicMotion, TeleportOfASkin_PutsHairOntoItAtRest) {
  const strands::Groom groom = ring(6);
  auto solver = make_classic(groom, "", {});
  const OffSkin off = after_teleport_of_skin(*solver, groom);
  EXPECT_LT(off.places, 1e-6);
  EXPECT_LT(off.speeds, 1e-4);
}

TEST(ClassicMotion, SkinThatCannotBeFollowed_IsRefused) {
  const strands::Groom groom = ring(2);
  auto classic = make_classic(groom, "", {});
  std::vector<glm::vec3> skinned = groom.positions;
  advance_on(*classic, skinned);
  EXPECT_FALSE(classic->advance({}).ok());
  skinned[3].y = NAN;
  EXPECT_THAT(classic->advance({.skinned = skinned}).error().message, ::testing::HasSubstr("skinned[3]"));
  skinned.pop_back();
  EXPECT_FALSE(classic->advance({.skinned = skinned}).ok());
}

}  // namespace
}  // namespace cuticle::sim::classic_motion_test
