#pragma once
// What the tests of the kernels share: a device, solvers on it, and what every kernel must hold.
#include "gpu/tests/test_device.h"
#include "sim/classic/test_strands.h"
#include "sim/solver_gpu.h"

namespace cuticle::sim::testing {

using tests::device;

inline std::unique_ptr<GpuSolver> make_gpu(std::string_view name, const strands::Groom& groom,
                                           const std::string& settings, const EffectBlocks& effects) {
  return (*find_gpu_effect(name))->create(device(), groom, settings_of(name, settings), effects).value();
}

inline const Sphere k_head{{0, 0, 0}, 0.095};

/// Dispatches of a recorded frame by pass.
inline std::map<std::string, std::uint32_t> recorded(GpuSolver& solver, const FrameInput& input) {
  gpu::Commands commands = device()->record();
  EXPECT_TRUE(solver.record(commands, input).ok());
  const gpu::SubmitCost cost = device()->submit(std::move(commands)).value();
  std::map<std::string, std::uint32_t> counts;
  for (const gpu::PassCost& pass : cost.passes) counts[pass.name] += pass.dispatches;
  return counts;
}

inline void expect_bit_identical_runs(std::string_view name, const strands::Groom& groom) {
  std::vector<State> states;
  for (int run = 0; run < 2; ++run) {
    auto kernel = make_gpu(name, groom, "", gravity_and_colliders());
    states.push_back(run_frames(*kernel, 10, {&k_head, 1}));
  }
  EXPECT_EQ(states[0].positions, states[1].positions);
  EXPECT_EQ(states[0].velocities, states[1].velocities);
}

/// Three frames, then a teleport with a turn, on both.
inline void expect_teleport_of_the_cpu(std::string_view name, const std::string& settings = {}, double most = 2e-5) {
  const strands::Groom groom = ring(20);
  auto cpu = make_solver(name, groom, settings, gravity());
  auto kernel = make_gpu(name, groom, settings, gravity());
  run_frames(*cpu, 3);
  run_frames(*kernel, 3);
  FrameInput input = frame_of(3);
  input.head_end = glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(4, 5, 6)), 2.0, glm::dvec3(1, 0, 0));
  input.teleport = true;
  ASSERT_TRUE(cpu->advance(input).ok());
  ASSERT_TRUE(kernel->advance(input).ok());
  EXPECT_LT(worst_distance(cpu->state()->positions, kernel->state()->positions), most);
}

}  // namespace cuticle::sim::testing
