// The kernel's aims by the frames that follow from them, against those of the CPU, and its dispatches.
#include "sim/classic/test_gpu.h"
#include "sim/clumping/test_clumps.h"

namespace cuticle::sim::clumping_gpu_test {
namespace {

using namespace testing;

class ClumpedKernel : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, ClumpedKernel, ::testing::Values("exact", "rod"),
                         [](const auto& info) { return info.param; });

std::string settings_for(std::string_view solver) { return solver == "rod" ? "sag_free=false" : ""; }

TEST_P(ClumpedKernel, Frames_AreThoseOfTheCpu) {
  const strands::Groom groom = ring(60);
  const EffectBlocks effects = gravity_and_clumps("strands_per_clump=5,rate=30");
  auto cpu = make_solver(GetParam(), groom, settings_for(GetParam()), effects);
  auto kernel = make_gpu(GetParam(), groom, settings_for(GetParam()), effects);
  auto without = make_solver(GetParam(), groom, settings_for(GetParam()), gravity());
  for (int frames : {1, 4}) {
    const State a = run_frames(*cpu, frames), b = run_frames(*kernel, frames), c = run_frames(*without, frames);
    const double places = worst_distance(a.positions, b.positions);
    std::printf("%s, clumps: CPU and kernel differ by %.1e m after %d frames more\n", GetParam(), places, frames);
    EXPECT_LT(places, 2e-5);
    EXPECT_GT(worst_distance(a.positions, c.positions), 1e-3);
  }
}

TEST_P(ClumpedKernel, TwoRuns_AreBitIdentical) {
  std::vector<State> states;
  for (int run = 0; run < 2; ++run)
    states.push_back(run_frames(*make_gpu(GetParam(), ring(60), "", gravity_and_clumps()), 4));
  EXPECT_EQ(states[0].positions, states[1].positions);
}

TEST_P(ClumpedKernel, OneDispatchMore_AndNoneWithoutTheEffectOrTime) {
  const strands::Groom groom = ring(40);
  auto with = make_gpu(GetParam(), groom, "", gravity_and_clumps());
  FrameInput still = frame_of(0);
  still.duration = 0;
  EXPECT_EQ(recorded(*with, still).count("clumping"), 0u);
  EXPECT_EQ(with->dispatches(still).count("clumping"), 0u);
  EXPECT_EQ(recorded(*with, frame_of(0)).at("clumping"), 1u);
  EXPECT_EQ(with->dispatches(frame_of(0)).at("clumping"), 1u);
  EXPECT_EQ((*find_effect("clumping"))->entry.dispatches({}, {}), 1u);
  auto without = make_gpu(GetParam(), groom, "", gravity());
  EXPECT_EQ(recorded(*without, frame_of(0)).count("clumping"), 0u);
}

}  // namespace
}  // namespace cuticle::sim::clumping_gpu_test
