// The kernels' sums against those of the CPU bit by bit, frames against its frames, and their dispatches.
#include "sim/classic/test_gpu.h"
#include "sim/strand_interaction/strand_interaction_gpu.h"
#include "sim/strand_interaction/test_bundle.h"
#include "tests/support/device_bound.h"

namespace cuticle::sim::strand_interaction_gpu_test {
namespace {

using namespace testing;
using namespace strand_interaction;

gpu::Buffer packed(std::span<const glm::vec3> vectors) {
  std::vector<glm::vec4> four;
  for (const glm::vec3& v : vectors) four.emplace_back(v, 1);
  return gpu::make_buffer_from(*device(), std::span<const glm::vec4>(four)).value();
}

TEST(StrandInteractionGpu, Sums_AreThoseOfTheCpuBitByBit) {
  const strands::Groom groom = ring(100);
  std::vector<glm::vec3> places = groom.positions, velocities = random_vectors(groom.vertex_count(), 20);
  places[40] = glm::vec3(0, 50, 0);
  velocities[60] = glm::vec3(-1e5f, 0, 300);
  const gpu::Buffer world = packed(places), moving = packed(velocities), state = packed(velocities);
  const VelocityLayout layout{std::vector<std::uint32_t>(groom.vertex_count(), VelocityLayout::k_carried), 1, 0};
  auto interaction = StrandInteractionGpu::create(*device(), groom, interaction_settings(), layout).value();
  gpu::Commands commands = device()->record();
  interaction->record(commands, {&world, &moving, &state}, glm::dmat3(1), glm::dvec3(0), 1.0 / 60);
  ASSERT_TRUE(device()->submit(std::move(commands)).ok());
  GridSums sums(make_strand_grid(groom, interaction_settings().cell).value());
  sums.deposit(places, velocities);
  const std::vector<NodeSums> found = interaction->sums(*device()).value();
  ASSERT_EQ(found.size(), sums.nodes().size());
  std::size_t different = 0;
  for (std::size_t k = 0; k < found.size(); ++k)
    different += found[k].mass != sums.nodes()[k].mass || found[k].momentum != sums.nodes()[k].momentum;
  EXPECT_EQ(different, 0u);
  EXPECT_EQ(interaction->left_out(*device()).value(), 2u);
  EXPECT_EQ(sums.left_out(), 2u);
}

class InteractingKernel : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, InteractingKernel, ::testing::Values("exact", "rod"),
                         [](const auto& info) { return info.param; });

TEST_P(InteractingKernel, Frames_StayNearTheCpu) {
  const strands::Groom groom = ring(60);
  const std::string settings = GetParam() == std::string("rod") ? "sag_free=false" : "";
  auto cpu = make_solver(GetParam(), groom, settings, gravity_and_interaction());
  auto kernel = make_gpu(GetParam(), groom, settings, gravity_and_interaction());
  for (int frames : {1, 4}) {
    const State a = run_frames(*cpu, frames), b = run_frames(*kernel, frames);
    const double places = worst_distance(a.positions, b.positions), speeds = worst_distance(a.velocities, b.velocities);
    std::printf("%s, strand against strand: CPU and kernel differ by %.1e m, %.1e m/s after %d frames more\n",
                GetParam(), places, speeds, frames);
    // A vertex that rounding puts across the next 1/32 of a cell feels a step.
    EXPECT_LT(places, frames == 1 ? 4e-6 : tests::bound_for(*device(), 7e-4, 2e-3));
    EXPECT_LT(speeds, tests::bound_for(*device(), 7e-3, 1.6e-2));
    EXPECT_EQ(b.left_out, 0u);
  }
}

TEST_P(InteractingKernel, TwoRuns_AreBitIdentical) {
  std::vector<State> states;
  for (int run = 0; run < 2; ++run)
    states.push_back(run_frames(*make_gpu(GetParam(), ring(60), "", gravity_and_interaction()), 4));
  EXPECT_EQ(states[0].positions, states[1].positions);
  EXPECT_EQ(states[0].velocities, states[1].velocities);
}

TEST_P(InteractingKernel, TwoDispatchesMore_AndNoneWithoutTheEffectOrTime) {
  const strands::Groom groom = ring(4);
  auto with = make_gpu(GetParam(), groom, "", gravity_and_interaction());
  FrameInput still = frame_of(0);
  still.duration = 0;
  EXPECT_EQ(recorded(*with, still).count("strand_interaction"), 0u);
  EXPECT_EQ(with->dispatches(still).count("strand_interaction"), 0u);
  EXPECT_EQ(recorded(*with, frame_of(0)).at("strand_interaction"), 2u);
  EXPECT_EQ(with->dispatches(frame_of(0)).at("strand_interaction"), 2u);
  EXPECT_EQ((*find_effect("strand_interaction"))->entry.dispatches({}, {}), 2u);
  auto without = make_gpu(GetParam(), groom, "", gravity());
  EXPECT_EQ(recorded(*without, frame_of(0)).count("strand_interaction"), 0u);
}

}  // namespace
}  // namespace cuticle::sim::strand_interaction_gpu_test
