// The kernels against the CPU twin, against themselves, and their cost against what the registry says.
#include "sim/classic/test_gpu.h"
#include "sim/control/control_gpu.h"
#include "strands/binding/carry_gpu.h"
#include "strands/skinning/skinning_gpu.h"
#include "tests/support/device_bound.h"

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
  EXPECT_LT(worst, tests::bound_for(*device(), 1e-6, 4e-5));
}

TEST(ClassicGpu, RedBlackWithSpheresAroundTargets_StaysNearCpuTwin) {
  const strands::Groom groom = ring(100);
  for (const std::string settings :
       {"order=red_black", "order=red_black,long_range=false,sphere_root=0.01,sphere_tip=0.1"}) {
    auto cpu = make_classic(groom, settings, gravity());
    auto kernels = make_gpu("classic", groom, settings, gravity());
    const double worst = worst_distance(run_frames(*cpu, 10).positions, run_frames(*kernels, 10).positions);
    std::printf("%s: after 10 frames %.2e m\n", settings.c_str(), worst);
    EXPECT_LT(worst, tests::bound_for(*device(), 1e-6, 1.2e-4));
  }
}

TEST(ClassicGpu, RedBlackBesideACollider_StaysNearCpuTwin) {
  const strands::Groom groom = ring(100);
  const std::string settings = "order=red_black,sphere_root=0.01,sphere_tip=0.1";
  auto cpu = make_classic(groom, settings, gravity_and_colliders());
  auto kernels = make_gpu("classic", groom, settings, gravity_and_colliders());
  const State a = run_frames(*cpu, 5, {&k_head, 1}), b = run_frames(*kernels, 5, {&k_head, 1});
  EXPECT_LT(worst_distance(a.positions, b.positions), tests::bound_for(*device(), 1e-6, 1e-4));
}

TEST(ClassicGpu, SphereThatMovesByItself_StaysNearCpuTwin) {
  const strands::Groom groom = ring(100);
  const MovingCollider moving{
      Sphere{{0, 0, 0}, 0.1}, {{{0, {.position = {0.3, -0.3, 0}}}, {0.1, {.position = {0.3, 0.3, 0}}}}}, false};
  auto cpu = make_classic(groom, "", gravity_and_colliders());
  auto kernels = make_gpu("classic", groom, "", gravity_and_colliders());
  for (int k = 0; k < 5; ++k) {
    FrameInput input = frame_of(k);
    input.colliders = {&k_head, 1};
    input.moving = {&moving, 1};
    input.clock_begin = k / 30.0;
    input.clock_end = (k + 1) / 30.0;
    ASSERT_TRUE(cpu->advance(input).ok());
    ASSERT_TRUE(kernels->advance(input).ok());
    input.colliders = {};
    EXPECT_EQ(kernels->dispatches(input).count("colliders"), 1u);
  }
  const double worst = worst_distance(cpu->state()->positions, kernels->state()->positions);
  std::printf("beside a sphere that moves by itself: CPU and GPU differ by %.2e m\n", worst);
  EXPECT_LT(worst, tests::bound_for(*device(), 1e-6, 3e-3));  // a vertex that rounding takes past the sphere goes its own way
}

/// The frames of run_frames with spheres, met by the strands that `reached` says.
State run_reached(auto& solver, std::span<const Sphere> spheres, std::span<const std::uint8_t> reached) {
  for (int k = 0; k < 4; ++k) {
    FrameInput input = frame_of(k);
    input.colliders = spheres;
    input.reached = reached;
    EXPECT_TRUE(solver.advance(input).ok());
  }
  return solver.state().value();
}

// Spheres that engulf the roots of all: whoever is asked meets them.
TEST(ClassicGpu, StrandsOutOfReach_AreNotTestedAndTheOthersMeetTheSameBitForBit) {
  const strands::Groom groom = ring(200);
  const Sphere wide{{0, 0, 0}, 0.12};
  const std::vector<std::uint8_t> all(200, 1), none(200, 0);
  std::vector<std::uint8_t> some(200, 0);
  for (std::size_t s = 0; s < 200; s += 3) some[s] = 1;
  for (const std::string settings : {"", "order=red_black"}) {
    const auto states = [&](std::span<const std::uint8_t> reached, std::span<const Sphere> spheres) {
      return std::pair(
          run_reached(*make_gpu("classic", groom, settings, gravity_and_colliders()), spheres, reached).positions,
          run_reached(*make_classic(groom, settings, gravity_and_colliders()), spheres, reached).positions);
    };
    const auto met = states({}, {&wide, 1}), free = states({}, {}), mixed = states(some, {&wide, 1});
    EXPECT_EQ(states(all, {&wide, 1}), met);
    EXPECT_EQ(states(none, {&wide, 1}), free);
    for (std::size_t s = 0; s < groom.strand_count(); ++s) {
      const auto& expected = some[s] ? met : free;
      for (std::size_t i = groom.offsets[s]; i < groom.offsets[s + 1]; ++i) {
        ASSERT_EQ(mixed.first[i], expected.first[i]) << settings << ", strand " << s << " on the device";
        ASSERT_EQ(mixed.second[i], expected.second[i]) << settings << ", strand " << s << " on the CPU";
      }
    }
    EXPECT_NE(met.first, free.first);
  }
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
    EXPECT_EQ(counts.at(std::string(name)), announced.at(name)) << name;
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
  EXPECT_EQ(recorded(*without_effect, spheres).count("colliders"), 0u);
  EXPECT_EQ(recorded(*without_spheres, none).count("colliders"), 0u);
  EXPECT_EQ(without_spheres->dispatches(none).count("colliders"), 0u);
}

TEST(ClassicGpu, StrandThatOverflows_IsResetAndCounted) {
  strands::Groom groom = ring(3);
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, {1e25, 1e25, 1e25});
  auto solver = make_gpu("classic", groom, "", gravity());
  const State state = run_frames(*solver, 5);
  EXPECT_EQ(state.guards_fired, 1u);
  EXPECT_EQ(state.resets, (std::vector<std::uint32_t>{0, 0, 0, 1}));
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

/// Two joints that turn against each other under a tube of 8 rings of 12 vertices along y.
struct Limb {
  strands::Mesh mesh;
  std::vector<strands::Influences> influences;
  std::vector<strands::Root> roots;
  strands::Groom groom;  ///< a strand on every triangle
};
Limb limb() {
  Limb limb;
  for (std::uint32_t y = 0; y < 8; ++y)
    for (std::uint32_t k = 0; k < 12; ++k) {
      const float angle = float(k) * 0.5235988f, share = float(y) / 7;
      limb.mesh.positions.emplace_back(0.1f * std::cos(angle), 0.05f * float(y), 0.1f * std::sin(angle));
      limb.influences.push_back({{0, 1, 0, 0}, {1 - share, share, 0, 0}});
      if (y == 7) continue;
      const std::uint32_t a = 12 * y + k, b = 12 * y + (k + 1) % 12;
      limb.mesh.triangles.push_back({a, a + 12, b});
      limb.mesh.triangles.push_back({b, a + 12, b + 12});
    }
  strands::compute_normals(limb.mesh);
  for (std::uint32_t t = 0; t < limb.mesh.triangles.size(); ++t) limb.roots.push_back({t, glm::vec3(1.f / 3)});
  const strands::Mesh at = strands::mesh_at_roots(limb.mesh, limb.roots);
  for (std::size_t s = 0; s < limb.roots.size(); ++s)
    add_straight(limb.groom, at.positions[s], at.normals[s], uniform_segments(7, 0.06));
  return limb;
}
std::vector<strands::JointMotion> bent(int frame) {
  const glm::dmat4 one(1), lifted = glm::translate(one, glm::dvec3(0, 0.02 * frame, 0));
  return strands::joint_motions(
      std::vector{lifted, glm::rotate(lifted, 0.9 * std::sin(0.3 * frame), glm::dvec3(0, 0, 1))});
}

TEST(ClassicGpu, HairOnASkin_IsSkinnedThenSimulatedInOneSubmission) {
  const Limb fur = limb();
  const strands::RestOnMesh rest = strands::rest_on_mesh(fur.groom, fur.mesh, fur.roots);
  auto skin = strands::GpuSkin::create(*device(), fur.mesh, fur.influences, 2,
                                       std::vector<float>(fur.mesh.positions.size(), 1.f));
  auto carried = strands::GpuCarry::create(*device(), rest);
  ASSERT_TRUE(skin && carried);
  auto kernels = make_gpu("classic", fur.groom, "", gravity());
  auto cpu = make_classic(fur.groom, "", gravity());
  double apart = 0, off_skin = 0, lag = 0;
  for (int frame = 0; frame < 20; ++frame) {
    const auto motions = bent(frame);
    gpu::Commands commands = device()->record();
    ASSERT_TRUE(skin->record(commands, motions, strands::Skinning::dual_quaternion));
    carried->record(commands, skin->positions(), skin->normals());
    ASSERT_TRUE(kernels->record_on_skin(commands, {.duration = 1.0 / 30}, carried->positions()));
    const gpu::SubmitCost cost = device()->submit(std::move(commands)).value();
    ASSERT_EQ(cost.passes.size(), 2u + 8);
    EXPECT_EQ(cost.passes[0].name, "skin");
    EXPECT_EQ(cost.passes[1].name, "carry");
    for (std::size_t k = 2; k < cost.passes.size(); ++k) EXPECT_EQ(cost.passes[k].name, "classic");

    strands::Mesh moved = fur.mesh;
    strands::skin(fur.mesh, fur.influences, motions, strands::Skinning::dual_quaternion, moved);
    std::vector<glm::vec3> nodes(fur.groom.vertex_count());
    strands::carry(rest, moved, nodes);
    ASSERT_TRUE(cpu->advance({.duration = 1.0 / 30, .skinned = nodes}).ok());
    const State state = kernels->state().value();
    apart = std::max(apart, worst_distance(state.positions, cpu->state()->positions));
    const strands::Mesh at = strands::mesh_at_roots(moved, fur.roots);
    for (std::size_t s = 0; s < fur.roots.size(); ++s) {
      off_skin = std::max(off_skin, double(glm::distance(state.positions[8 * s], at.positions[s])));
      lag = std::max(lag, double(glm::distance(state.positions[8 * s + 7], nodes[8 * s + 7])));
    }
  }
  std::printf("hair on a skin, 20 frames: CPU and GPU %.1e m apart, roots %.1e m off, tips up to %.1e m behind\n",
              apart, off_skin, lag);
  EXPECT_LT(apart, tests::bound_for(*device(), 1e-6, 6e-5));
  EXPECT_LT(off_skin, 3e-7);
  EXPECT_GT(lag, 5e-3);
}

TEST(ClassicGpu, SolverOfAHead_RefusesASkin) {
  const strands::Groom groom = ring(2);
  auto kernels = control::controlled_gpu(device(), make_gpu("exact", groom, "", gravity()), groom,
                                         registry::from_values<control::Control>(settings_of("control")))
                     .value();
  gpu::Commands commands = device()->record();
  EXPECT_FALSE(kernels->record_on_skin(commands, {}, kernels->positions()).ok());
}

TEST(ClassicGpu, Teleport_EqualsCpuTwin) { expect_teleport_of_the_cpu("classic"); }

TEST(ClassicGpu, EmptyGroom_IsRefused) {
  const auto made = (*find_gpu_effect("classic"))->create(device(), strands::Groom{}, settings_of("classic"), {});
  EXPECT_FALSE(made.ok());
}

}  // namespace
}  // namespace cuticle::sim::classic_gpu_test
