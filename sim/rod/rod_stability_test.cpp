// The rod in the cases in which strand solvers are known to break.
#include "sim/chains/test_stability.h"

namespace cuticle::sim::rod_stability_test {
namespace {

using namespace testing;

const std::string k_nominal = "damping=2", k_limp = "damping=2,young_modulus=0,shear_modulus=0",
                  k_rigid = "damping=2,young_modulus=3.9e18,shear_modulus=0.9e18",
                  k_twistless = "damping=2,shear_modulus=0,sag_free=false";

TEST(RodStability, EveryShapeStepStiffnessAndDisturbance_KeepsItsLengths) {
  expect_lengths("rod", {k_nominal, k_limp, k_rigid, k_twistless}, 30);
}

TEST(RodStability, InDouble_KeepsItsLengths) {
  expect_lengths("rod", {k_nominal + ",double_precision=true", k_rigid + ",double_precision=true"}, 15);
}

TEST(RodStability, AfterKicksAndJumps_ComesToRest) {
  for (const char* young : {"3.9e9", "3.9e12", "3.9e18"})
    for (double duration : {1.0 / 480, 1.0 / 60, 0.1, 1.0}) {
      const strands::Groom groom = one(uniform_segments(31, 0.1));
      auto solver = make_solver("rod", groom, settings("damping=5,young_modulus=" + std::string(young)), gravity());
      FrameInput input{
          .duration = duration, .head_end = glm::translate(glm::dmat4(1), glm::dvec3(10, 20, 0)), .colliders = {}};
      ASSERT_TRUE(solver->advance(input).ok());
      input.head_begin = input.head_end;
      for (int k = 0; k < int(10 / std::min(duration, 0.05)); ++k) ASSERT_TRUE(solver->advance(input).ok());
      const double late = fastest(*solver->state()) * std::min(1.0, duration * 60);
      std::printf("E %s Pa, 10 s after a jump, steps of %.4f s: fastest vertex %.1e m/s\n", young, duration, late);
      EXPECT_LT(late, 1e-2) << young << " " << duration;
    }
}

TEST(RodContact, StrandsOnBalls_KeepLengthStayOutsideAndComeToRest) {
  for (const BallCase& ball : k_balls) {
    const Rest rest = rest_on(ball, "rod", "damping=5,sag_free=false");
    std::printf("%-30s stretch over bound %.2f, deepest segment %.1e r, tip after 5 s %.1e m/s\n", ball.name,
                rest.stretch, rest.depth, rest.tip_speed);
    EXPECT_LE(rest.stretch, 1) << ball.name;
    EXPECT_LT(rest.depth * ball.radius, 5e-7 * ball.radius + 1e-8) << ball.name;  // places 0.1 m away round to 7e-9 m
    EXPECT_LT(rest.tip_speed, ball.resting) << ball.name;
  }
}

TEST(RodHard, StrandWhoseSquaresOverflow_TouchesNoOther) {
  const strands::Groom good = ring(20);
  strands::Groom mixed = good;
  add_straight(mixed, {0, 0, 0}, {1, 0, 0}, std::vector<double>(16, 1e25));
  auto alone = make_solver("rod", good, "", gravity()), beside = make_solver("rod", mixed, "", gravity());
  const State expected = run_frames(*alone, 20), state = run_frames(*beside, 20);
  EXPECT_TRUE(all_finite(state));
  for (std::size_t i = 0; i < good.vertex_count(); ++i) ASSERT_EQ(state.positions[i], expected.positions[i]);
}

}  // namespace
}  // namespace cuticle::sim::rod_stability_test
