// The kernels against the CPU twin, against themselves, and their cost against what the registry says.
#include <cuticle/sim/classic/test_strands.h>
#include <cuticle/sim/solver_gpu.h>

namespace cuticle::sim {
namespace {

using namespace testing;

std::shared_ptr<gpu::Device> device() {
  static const std::shared_ptr<gpu::Device> shared = gpu::Device::open().value();
  return shared;
}
std::unique_ptr<GpuSolver> make_gpu(const strands::Groom& groom, const std::string& solver, const EffectBlocks& effects) {
  return (*find_gpu_effect("classic"))->create(device(), groom, settings_of("classic", solver), effects).value();
}

const Sphere k_head{{0, 0, 0}, 0.095};

TEST(ClassicGpu, OneSubstep_EqualsCpuTwinToRounding) {
  const strands::Groom groom = ring(100);
  auto cpu = make_classic(groom, "inner_step=1", gravity_and_colliders());
  auto kernels = make_gpu(groom, "inner_step=1", gravity_and_colliders());
  const State a = run_frames(*cpu, 1, {&k_head, 1}), b = run_frames(*kernels, 1, {&k_head, 1});
  const double worst = worst_distance(a.positions, b.positions);
  std::printf("after 1 substep: CPU and GPU differ by %.2e m\n", worst);
  EXPECT_LT(worst, 1e-6);
}

TEST(ClassicGpu, TenFrames_StayNearCpuTwin) {
  const strands::Groom groom = ring(100);
  auto cpu = make_classic(groom, "", gravity_and_colliders());
  auto kernels = make_gpu(groom, "", gravity_and_colliders());
  const State a = run_frames(*cpu, 10, {&k_head, 1}), b = run_frames(*kernels, 10, {&k_head, 1});
  const double worst = worst_distance(a.positions, b.positions);
  std::printf("after 10 frames of 8 substeps: %.2e m\n", worst);
  EXPECT_LT(worst, 1e-3);
}

TEST(ClassicGpu, TwoRuns_AreBitIdentical) {
  const strands::Groom groom = ring(100);
  std::vector<State> states;
  for (int run = 0; run < 2; ++run) {
    auto kernels = make_gpu(groom, "", gravity_and_colliders());
    states.push_back(run_frames(*kernels, 10, {&k_head, 1}));
  }
  EXPECT_EQ(states[0].positions, states[1].positions);
  EXPECT_EQ(states[0].velocities, states[1].velocities);
}

std::map<std::string, std::uint32_t> recorded(GpuSolver& solver, const FrameInput& input) {
  gpu::Commands commands = device()->record();
  EXPECT_TRUE(solver.record(commands, input).ok());
  const gpu::SubmitCost cost = device()->submit(std::move(commands)).value();
  std::map<std::string, std::uint32_t> counts;
  for (const gpu::PassCost& pass : cost.passes) counts[pass.name] += pass.dispatches;
  return counts;
}

TEST(ClassicGpu, DispatchesOfAFrame_AreThoseTheRegistryStates) {
  const strands::Groom groom = ring(4);
  auto solver = make_gpu(groom, "", gravity_and_colliders());
  FrameInput input = frame_of(0);
  input.colliders = {&k_head, 1};
  const Effect& classic = **find_effect("classic");
  const registry::FrameShape shape{.substeps = classic.substeps(settings_of("classic"), input.duration)};
  const auto counts = recorded(*solver, input), announced = solver->dispatches(input);
  EXPECT_EQ(shape.substeps, 8u);
  ASSERT_EQ(counts.size(), 2u);
  for (const char* name : {"classic", "colliders"}) {
    EXPECT_EQ(counts.at(std::string("simulate.") + name), announced.at(name)) << name;
    EXPECT_EQ(announced.at(name), (*find_effect(name))->entry.dispatches(settings_of(name), shape)) << name;
  }
}

TEST(ClassicGpu, NoColliders_NoCollisionDispatch) {
  const strands::Groom groom = ring(4);
  const FrameInput none = frame_of(0);
  FrameInput spheres = none;
  spheres.colliders = {&k_head, 1};
  auto without_effect = make_gpu(groom, "", gravity()), without_spheres = make_gpu(groom, "", gravity_and_colliders());
  EXPECT_EQ(recorded(*without_effect, spheres).count("simulate.colliders"), 0u);
  EXPECT_EQ(recorded(*without_spheres, none).count("simulate.colliders"), 0u);
  EXPECT_EQ(without_spheres->dispatches(none).count("colliders"), 0u);
}

TEST(ClassicGpu, StrandThatOverflows_IsResetAndCounted) {
  strands::Groom groom = ring(3);
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, {1e25, 1e25, 1e25});
  auto solver = make_gpu(groom, "", gravity());
  const State state = run_frames(*solver, 5);
  EXPECT_EQ(state.guards_fired, 1u);
  EXPECT_TRUE(all_finite(state));
}

TEST(ClassicGpu, HardSteps_StayFinite) {
  strands::Groom groom = ring(3);
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, {});
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, {0, 0, 0.05, 0});
  for (double duration : {0.0, 1e-3, 1.0, 100.0}) {
    auto solver = make_gpu(groom, k_free, gravity_and_colliders());
    const State state = run_still(*solver, 5, duration, {&k_head, 1});
    EXPECT_TRUE(all_finite(state)) << duration;
    EXPECT_EQ(state.guards_fired, 0u) << duration;
  }
}

TEST(ClassicGpu, Teleport_EqualsCpuTwin) {
  const strands::Groom groom = ring(20);
  auto cpu = make_classic(groom, "", gravity());
  auto kernels = make_gpu(groom, "", gravity());
  run_frames(*cpu, 3);
  run_frames(*kernels, 3);
  FrameInput input = frame_of(3);
  input.head_end = glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(4, 5, 6)), 2.0, glm::dvec3(1, 0, 0));
  input.teleport = true;
  ASSERT_TRUE(cpu->advance(input).ok());
  ASSERT_TRUE(kernels->advance(input).ok());
  EXPECT_LT(worst_distance(cpu->state()->positions, kernels->state()->positions), 2e-5);
}

TEST(ClassicGpu, EmptyGroom_IsRefused) {
  const auto made = (*find_gpu_effect("classic"))->create(device(), strands::Groom{}, settings_of("classic"), {});
  EXPECT_FALSE(made.ok());
}

}  // namespace
}  // namespace cuticle::sim
