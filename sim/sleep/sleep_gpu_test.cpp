// Sleep on the device: as on the CPU, and skipped within the one dispatch.
#include "sim/classic/test_gpu.h"
#include "tests/support/device_bound.h"

namespace cuticle::sim::sleep_gpu_test {
namespace {

using namespace testing;

class SleepingKernel : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, SleepingKernel, ::testing::Values("exact", "rod"),
                         [](const auto& info) { return info.param; });

TEST_P(SleepingKernel, StrandsAtRest_SleepAsOnTheCpuAndWakeWithTheHead) {
  const strands::Groom groom = ring(20);
  EffectBlocks effects = gravity();
  effects["sleep"] = settings_of("sleep", "time=0.1");
  const std::string settings = GetParam() == std::string("rod") ? "fibre_radius=1e-3" : "";
  auto cpu = make_solver(GetParam(), groom, settings, effects);
  auto kernel = make_gpu(GetParam(), groom, settings, effects);
  for (int frames : {1, 7, 10}) {
    const State a = run_still(*cpu, frames, 1.0 / 60), b = run_still(*kernel, frames, 1.0 / 60);
    EXPECT_EQ(a.asleep, b.asleep) << frames;
  }
  const State before = kernel->state().value(), later = run_still(*kernel, 20, 1.0 / 60);
  EXPECT_EQ(later.asleep, 20u);
  EXPECT_EQ(before.positions, later.positions);
  EXPECT_EQ(recorded(*kernel, FrameInput{}).at(std::string(GetParam())), 1u);
  auto awake_cpu = make_solver(GetParam(), groom, settings, gravity());
  auto awake_kernel = make_gpu(GetParam(), groom, settings, gravity());
  run_still(*awake_cpu, 39, 1.0 / 60);
  run_still(*awake_kernel, 39, 1.0 / 60);
  const State a = run_frames(*cpu, 3), b = run_frames(*kernel, 3);
  EXPECT_EQ(b.asleep, 0u);
  const double apart = worst_distance(a.positions, b.positions),
               awake_apart =
                   worst_distance(run_frames(*awake_cpu, 3).positions, run_frames(*awake_kernel, 3).positions);
  std::printf("%s woken on the CPU and the device: %.1e m apart after 3 frames (without sleep %.1e)\n", GetParam(),
              apart, awake_apart);
  EXPECT_LT(apart, tests::bound_for(*device(), 1.6e-4, 3e-4));
}

TEST_P(SleepingKernel, ColliderThatMoves_WakesTheStrandsThatItMayReach) {
  EffectBlocks effects = gravity_and_colliders();
  effects["sleep"] = settings_of("sleep", "time=0.1");
  const std::string settings = GetParam() == std::string("rod") ? "fibre_radius=1e-3" : "";
  auto kernel = make_gpu(GetParam(), ring(20), settings, effects);
  std::vector<std::uint8_t> reached(20, 0);
  reached[7] = 1;
  Sphere ball{{5, 0, 0}, 0.1};
  const auto asleep_after = [&](int frames) {
    for (int k = 0; k < frames; ++k) EXPECT_TRUE(kernel->advance({.colliders = {&ball, 1}, .reached = reached}).ok());
    return kernel->state()->asleep;
  };
  ASSERT_EQ(asleep_after(20), 20u);
  ball.center.x = 4;
  EXPECT_EQ(asleep_after(1), 19u);
  EXPECT_EQ(asleep_after(20), 20u);
}

}  // namespace
}  // namespace cuticle::sim::sleep_gpu_test
