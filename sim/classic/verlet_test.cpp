// The step's formula against closed forms, in double, so that only the scheme is on trial.
#include <cmath>

#include <gtest/gtest.h>

#include "sim/classic/verlet.glslh"
#include "sim/turn.glslh"

namespace cuticle::sim::verlet_test {
namespace {

using glm::dvec3;

/// Position after `time` in steps of h, from x0 with v0; the first step starts from a true velocity, so its fall is
/// half.
dvec3 run(dvec3 x0, dvec3 v0, dvec3 acceleration, double damping, double stiffness, double h, double time) {
  dvec3 x = x0, displacement = v0 * h;
  const int steps = int(std::lround(time / h));
  for (int k = 0; k < steps; ++k) {
    const dvec3 fall = acceleration * (h * h * (k == 0 ? 0.5 : 1.0));
    const dvec3 next = verlet_position(x, displacement * std::exp(-damping * h), dvec3(0), dvec3(0), dvec3(0),
                                       kept(stiffness * h), fall);
    displacement = next - x;
    x = next;
  }
  return x;
}

TEST(Verlet, FreeFall_IsExactAtEveryStep) {
  for (double h : {1.0 / 960, 1.0 / 60, 0.25}) {
    const dvec3 end = run({1, 2, 3}, {0.5, 1, -2}, {0, -9.8, 1}, 0, 0, h, 1);
    EXPECT_LT(glm::distance(end, dvec3(1.5, 2 + 1 - 4.9, 3 - 2 + 0.5)), 1e-10) << h;  // rounding, summed over the steps
  }
}

TEST(Verlet, NoPull_GivesStraightLineInWorldWhateverTheHeadDoes) {
  const dvec3 here(0.1, 0.2, 0.3), moved(0.01, 0, -0.02), head(0.3, -0.1, 0.2);
  const dvec3 next = verlet_position(here, moved, dvec3(0.4, 0, 0), dvec3(0, 0.4, 0), head, 1.0, dvec3(0));
  EXPECT_LT(glm::distance(next + head, here + moved), 1e-15);
}

TEST(Verlet, Damping_DecaysEquallyAtEveryStep) {
  const double c = 3, speed = 2;
  double travelled[2];
  for (int k : {0, 1}) {
    const double h = k ? 1.0 / 480 : 1.0 / 60;
    travelled[k] = run({}, {speed, 0, 0}, {}, c, 0, h, 1 + h).x - run({}, {speed, 0, 0}, {}, c, 0, h, 1).x;
    EXPECT_NEAR(travelled[k] / h, speed * std::exp(-c * (1 + h)), 1e-12) << h;
  }
}

TEST(Verlet, Pull_FollowsCriticallyDampedOscillatorAtEveryStep) {
  // y(t) = (1 + a t) exp(-w t) with the displacement before t = 0 taken from the same solution.
  const double w = 12, a = 4;
  const auto truth = [&](double t) { return (1 + a * t) * std::exp(-w * t); };
  for (double h : {1.0 / 960, 1.0 / 60, 0.5}) {
    dvec3 x(truth(0), 0, 0), displacement(truth(0) - truth(-h), 0, 0);
    for (int k = 1; k <= 4; ++k) {
      const dvec3 next = verlet_position(x, displacement, dvec3(0), dvec3(0), dvec3(0), kept(w * h), dvec3(0));
      displacement = next - x;
      x = next;
      EXPECT_NEAR(x.x, truth(k * h), 1e-13) << h;
    }
  }
}

TEST(Verlet, EndlessStep_ArrivesAtRestPose) {
  const dvec3 next = verlet_position(dvec3(5, 6, 7), dvec3(9), dvec3(1), dvec3(2, 0, 1), dvec3(3), kept(1e6), dvec3(0));
  EXPECT_EQ(next, dvec3(2, 0, 1));
}

TEST(Turn, QuarterTurnAboutVertical_TakesXToMinusZ) {
  const double half = std::sqrt(0.5);
  EXPECT_LT(glm::distance(turned(dvec3(1, 2, 0), dvec3(0, half, 0), half), dvec3(0, 2, -1)), 1e-15);
}

}  // namespace
}  // namespace cuticle::sim::verlet_test
