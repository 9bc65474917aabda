// The kernel against the CPU, against itself, and its cost against what the registry says.
#include <cuticle/sim/classic/test_strands.h>
#include <cuticle/sim/solver_gpu.h>

namespace cuticle::sim {
namespace {

using namespace testing;

std::shared_ptr<gpu::Device> device() {
  static const std::shared_ptr<gpu::Device> shared = gpu::Device::open().value();
  return shared;
}
std::unique_ptr<GpuSolver> make_gpu(const strands::Groom& groom, const std::string& solver,
                                    const EffectBlocks& effects) {
  return (*find_gpu_effect("exact"))->create(device(), groom, settings_of("exact", solver), effects).value();
}

const Sphere k_head{{0, 0, 0}, 0.095};

/// Strands of several lengths, with welded segments and without links.
strands::Groom mixed() {
  strands::Groom groom = ring(70);
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, {});
  add_straight(groom, {0, 0.1, 0}, {1, 0, 0}, {0.02, 0, 0.05, 0, 0.03});
  add_straight(groom, {0, 0.1, 0}, {0, 1, 0}, uniform_segments(5, 0.2));
  return groom;
}

TEST(ExactGpu, EveryVariant_StaysNearTheCpu) {
  const strands::Groom groom = mixed();
  for (const std::string& settings : {std::string(), k_free})
    for (const EffectBlocks& effects : {gravity(), gravity_and_colliders()}) {
      auto cpu = make_exact(groom, settings, effects);
      auto kernel = make_gpu(groom, settings, effects);
      const State a1 = run_frames(*cpu, 1, {&k_head, 1}), b1 = run_frames(*kernel, 1, {&k_head, 1});
      const State a = run_frames(*cpu, 4, {&k_head, 1}), b = run_frames(*kernel, 4, {&k_head, 1});
      const double one = worst_distance(a1.positions, b1.positions), five = worst_distance(a.positions, b.positions);
      std::printf("%s, %s: CPU and kernel differ by %.1e m after 1 frame, %.1e m after 5\n",
                  settings.empty() ? "pulled" : "free", effects.size() > 1 ? "sphere" : "no sphere", one, five);
      EXPECT_LT(one, 5e-6);
      EXPECT_LT(five, 1e-4);
      EXPECT_LT(worst_distance(a1.velocities, b1.velocities), 5e-3);
    }
}

TEST(ExactGpu, TwoRuns_AreBitIdentical) {
  std::vector<State> states;
  for (int run = 0; run < 2; ++run) {
    auto kernel = make_gpu(mixed(), "", gravity_and_colliders());
    states.push_back(run_frames(*kernel, 10, {&k_head, 1}));
  }
  EXPECT_EQ(states[0].positions, states[1].positions);
  EXPECT_EQ(states[0].velocities, states[1].velocities);
}

TEST(ExactGpu, DispatchesOfAFrame_AreThoseTheRegistryStates) {
  auto solver = make_gpu(ring(4), "", gravity_and_colliders());
  FrameInput input = frame_of(0);
  input.colliders = {&k_head, 1};
  gpu::Commands commands = device()->record();
  ASSERT_TRUE(solver->record(commands, input).ok());
  const gpu::SubmitCost cost = device()->submit(std::move(commands)).value();
  ASSERT_EQ(cost.passes.size(), 1u);
  EXPECT_EQ(cost.passes[0].name, "simulate.exact");
  EXPECT_EQ(cost.passes[0].dispatches, (*find_effect("exact"))->entry.dispatches(settings_of("exact"), {}));
  EXPECT_TRUE((*find_effect("exact"))->fuses_effects);
  EXPECT_EQ(solver->dispatches(input).at("exact"), cost.passes[0].dispatches);
}

TEST(ExactGpu, HardSteps_KeepLengths) {
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, uniform_segments(31, 0.3));
  for (double duration : {0.0, 1e-3, 1.0, 100.0}) {
    const State state = run_still(*make_gpu(groom, k_free + ",inner_step=100", gravity()), 5, duration);
    EXPECT_TRUE(all_finite(state)) << duration;
    EXPECT_LT(worst_stretch(groom, state), 1e-5) << duration;
  }
}

TEST(ExactGpu, Teleport_EqualsTheCpu) {
  const strands::Groom groom = ring(20);
  auto cpu = make_exact(groom, "", gravity());
  auto kernel = make_gpu(groom, "", gravity());
  run_frames(*cpu, 3);
  run_frames(*kernel, 3);
  FrameInput input = frame_of(3);
  input.head_end = glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(4, 5, 6)), 2.0, glm::dvec3(1, 0, 0));
  input.teleport = true;
  ASSERT_TRUE(cpu->advance(input).ok());
  ASSERT_TRUE(kernel->advance(input).ok());
  EXPECT_LT(worst_distance(cpu->state()->positions, kernel->state()->positions), 2e-5);
}

TEST(ExactGpu, DoublePrecision_IsRefused) {
  const auto made =
      (*find_gpu_effect("exact"))->create(device(), ring(1), settings_of("exact", "double_precision=true"), {});
  EXPECT_FALSE(made.ok());
}

}  // namespace
}  // namespace cuticle::sim
