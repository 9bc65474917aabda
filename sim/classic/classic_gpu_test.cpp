// The kernels against the CPU twin, against themselves, and their cost against what the registry says.
#include <cuticle/sim/classic/test_gpu.h>

namespace cuticle::sim::classic_gpu_test {
namespace {

using namespace testing;

TEST(ClassicGpu, OneSubstep_EqualsCpuTwinToRounding) {
  const strands::Groom groom = ring(100);
  auto cpu = make_classic(groom, "inner_step=1", gravity_and_colliders());
  auto kernels = make_gpu("classic", groom, "inner_step=1", gravity_and_colliders());
  const State a = run_frames(*cpu, 1, {&k_head, 1}), b = run_frames(*kernels, 1, {&k_head, 1});
  const double worst = worst_distance(a.positions, b.positions);
  std::printf("after 1 substep: CPU and GPU differ by %.2e m\n", worst);
  EXPECT_LT(worst, 1e-6);
}

TEST(ClassicGpu, TenFrames_StayNearCpuTwin) {
  const strands::Groom groom = ring(100);
  auto cpu = make_classic(groom, "", gravity_and_colliders());
  auto kernels = make_gpu("classic", groom, "", gravity_and_colliders());
  const State a = run_frames(*cpu, 10, {&k_head, 1}), b = run_frames(*kernels, 10, {&k_head, 1});
  const double worst = worst_distance(a.positions, b.positions);
  std::printf("after 10 frames of 8 substeps: %.2e m\n", worst);
  EXPECT_LT(worst, 1e-6);
}

TEST(ClassicGpu, RedBlackWithSpheresAroundTargets_StaysNearCpuTwin) {
  const strands::Groom groom = ring(100);
  for (const std::string settings :
       {"order=red_black", "order=red_black,long_range=false,sphere_root=0.01,sphere_tip=0.1"}) {
    auto cpu = make_classic(groom, settings, gravity());
    auto kernels = make_gpu("classic", groom, settings, gravity());
    const double worst = worst_distance(run_frames(*cpu, 10).positions, run_frames(*kernels, 10).positions);
    std::printf("%s: after 10 frames %.2e m\n", settings.c_str(), worst);
    EXPECT_LT(worst, 1e-6);
  }
}

TEST(ClassicGpu, RedBlackBesideACollider_StaysNearCpuTwin) {
  const strands::Groom groom = ring(100);
  const std::string settings = "order=red_black,sphere_root=0.01,sphere_tip=0.1";
  auto cpu = make_classic(groom, settings, gravity_and_colliders());
  auto kernels = make_gpu("classic", groom, settings, gravity_and_colliders());
  const State a = run_frames(*cpu, 5, {&k_head, 1}), b = run_frames(*kernels, 5, {&k_head, 1});
  EXPECT_LT(worst_distance(a.positions, b.positions), 1e-6);
}

TEST(ClassicGpu, TwoRuns_AreBitIdentical) { expect_bit_identical_runs("classic", ring(100)); }

TEST(ClassicGpu, DispatchesOfAFrame_AreThoseTheRegistryStates) {
  const strands::Groom groom = ring(4);
  auto solver = make_gpu("classic", groom, "", gravity_and_colliders());
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
  auto without_effect = make_gpu("classic", groom, "", gravity()),
       without_spheres = make_gpu("classic", groom, "", gravity_and_colliders());
  EXPECT_EQ(recorded(*without_effect, spheres).count("simulate.colliders"), 0u);
  EXPECT_EQ(recorded(*without_spheres, none).count("simulate.colliders"), 0u);
  EXPECT_EQ(without_spheres->dispatches(none).count("colliders"), 0u);
}

TEST(ClassicGpu, StrandThatOverflows_IsResetAndCounted) {
  strands::Groom groom = ring(3);
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, {1e25, 1e25, 1e25});
  auto solver = make_gpu("classic", groom, "", gravity());
  const State state = run_frames(*solver, 5);
  EXPECT_EQ(state.guards_fired, 1u);
  EXPECT_TRUE(all_finite(state));
}

TEST(ClassicGpu, HardSteps_StayFinite) {
  strands::Groom groom = ring(3);
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, {});
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, {0, 0, 0.05, 0});
  for (double duration : {0.0, 1e-3, 1.0, 100.0}) {
    auto solver = make_gpu("classic", groom, k_free, gravity_and_colliders());
    const State state = run_still(*solver, 5, duration, {&k_head, 1});
    EXPECT_TRUE(all_finite(state)) << duration;
    EXPECT_EQ(state.guards_fired, 0u) << duration;
  }
}

TEST(ClassicGpu, Teleport_EqualsCpuTwin) { expect_teleport_of_the_cpu("classic"); }

TEST(ClassicGpu, EmptyGroom_IsRefused) {
  const auto made = (*find_gpu_effect("classic"))->create(device(), strands::Groom{}, settings_of("classic"), {});
  EXPECT_FALSE(made.ok());
}

}  // namespace
}  // namespace cuticle::sim::classic_gpu_test
