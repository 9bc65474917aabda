// The kernels of the solvers of rigid links against the CPU, against themselves, and their cost against what the
// registry says.
#include "sim/classic/test_gpu.h"
#include "sim/colliders/distance_field.h"
#include "sim/colliders/test_meshes.h"
#include "tests/support/device_bound.h"

namespace cuticle::sim::chain_gpu_test {
namespace {

using namespace testing;

class ChainGpu : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, ChainGpu, ::testing::Values("exact", "rod"),
                         [](const auto& info) { return info.param; });

/// Strands of several lengths, with welded segments and without links.
strands::Groom mixed() {
  strands::Groom groom = ring(70);
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, {});
  add_straight(groom, {0, 0.1, 0}, {1, 0, 0}, {0.02, 0, 0.05, 0, 0.03});
  add_straight(groom, {0, 0.1, 0}, {0, 1, 0}, uniform_segments(5, 0.2));
  return groom;
}

/// Limp rods that hang as they like. Those that balance a slanted rest pose part within 0.2 s by rounding alone.
constexpr const char* k_slack = "sag_free=false";

struct Variant {
  std::string solver, settings;
};
const Variant k_variants[] = {{"exact", ""}, {"exact", k_free}, {"rod", k_slack}, {"rod", "fibre_radius=1e-3"}};

TEST(ChainGpuVariants, Each_StaysNearTheCpu) {
  const strands::Groom groom = mixed();
  for (const auto& [solver, settings] : k_variants)
    for (const EffectBlocks& effects : {gravity(), gravity_and_colliders()}) {
      auto cpu = make_solver(solver, groom, settings, effects);
      auto kernel = make_gpu(solver, groom, settings, effects);
      const State a1 = run_frames(*cpu, 1, {&k_head, 1}), b1 = run_frames(*kernel, 1, {&k_head, 1});
      const State a = run_frames(*cpu, 4, {&k_head, 1}), b = run_frames(*kernel, 4, {&k_head, 1});
      const double speeds = worst_distance(a1.velocities, b1.velocities);
      const double one = worst_distance(a1.positions, b1.positions), five = worst_distance(a.positions, b.positions);
      std::printf("%s %s, %s: CPU and kernel differ by %.1e m after 1 frame, %.1e m after 5, %.1e m/s\n",
                  solver.c_str(), settings.c_str(), effects.size() > 1 ? "sphere" : "no sphere", one, five, speeds);
      EXPECT_LT(one, 5e-6);
      EXPECT_LT(five, 3.5e-5);
      EXPECT_LT(speeds, tests::bound_for(*device(), 3e-4, 6e-4));
    }
}

/// Of the CPU's vertices from the kernel's after three frames of a turning head beside these colliders.
double apart_beside(const char* solver, const FrameInput& colliders) {
  const strands::Groom groom = ring(20);
  const std::string settings = solver == std::string("rod") ? k_slack : "";
  auto cpu = make_solver(solver, groom, settings, gravity_and_colliders());
  auto kernel = make_gpu(solver, groom, settings, gravity_and_colliders());
  for (int k = 0; k < 3; ++k) {
    FrameInput input = colliders;
    const FrameInput head = frame_of(k);
    input.duration = head.duration;
    input.head_begin = head.head_begin;
    input.head_end = head.head_end;
    EXPECT_TRUE(cpu->advance(input).ok());
    EXPECT_TRUE(kernel->advance(input).ok());
    EXPECT_EQ(kernel->dispatches(input).at(solver), 1u);
  }
  return worst_distance(cpu->state()->positions, kernel->state()->positions);
}

TEST_P(ChainGpu, CapsuleAndBox_StayNearTheCpuInOneDispatch) {
  const RoundedBox boxes[] = {make_capsule({0.3, 0, -0.1}, {0.3, 0, 0.1}, 0.1),
                              {{0, -0.03, 0}, glm::dmat3(1), {1, 0.018, 1}, 0.002}};
  const double apart = apart_beside(GetParam(), {.colliders = {&k_head, 1}, .boxes = boxes});
  std::printf("%s beside a sphere, a capsule and a box: CPU and kernel %.1e m apart after 3 frames\n", GetParam(),
              apart);
  EXPECT_LT(apart, GetParam() == std::string("rod") ? 1e-3 : 1.5e-5);
}

TEST_P(ChainGpu, Meshes_StayNearTheCpuInOneDispatch) {
  const auto field = [](const strands::Mesh& mesh, const glm::dvec3& place) {
    return std::make_shared<const DistanceField>(
        *bake_distance_field(strands::transformed(mesh, glm::translate(glm::dmat4(1), place)), 0.02, "mesh"));
  };
  // What 'exact' touches is the second, whose numbers follow those of the first.
  const FieldPointer fields[] = {field(box_mesh({1, 0.02, 1}), {0, -0.03, 0}), field(ball_mesh(0.1, 24), {0.35, 0, 0})};
  const double apart = apart_beside(GetParam(), {.colliders = {&k_head, 1}, .fields = fields});
  std::printf("%s beside a sphere and two meshes: CPU and kernel %.1e m apart after 3 frames\n", GetParam(), apart);
  EXPECT_LT(apart, GetParam() == std::string("rod") ? 1e-3 : 1.5e-5);
}

/// One solver for each way of moving all vertices to the next float along an axis.
std::vector<std::unique_ptr<Solver>> next_floats(const char* name, const strands::Groom& groom,
                                                 const std::string& settings, const EffectBlocks& effects) {
  std::vector<std::unique_ptr<Solver>> solvers;
  for (int axis = 0; axis < 3; ++axis)
    for (float towards : {-INFINITY, INFINITY}) {
      strands::Groom moved = groom;
      for (glm::vec3& place : moved.positions) place[axis] = std::nextafter(place[axis], towards);
      solvers.push_back(make_solver(name, moved, settings, effects));
    }
  return solvers;
}

TEST_P(ChainGpu, CollidersThatMoveByThemselves_StayNearTheCpuInOneDispatch) {
  const FieldPointer ball =
      std::make_shared<const DistanceField>(*bake_distance_field(ball_mesh(0.1, 24), 0.02, "ball"));
  const auto key = [](double time, double angle, const glm::dvec3& place) {
    return MotionKey{time, {glm::angleAxis(angle, glm::dvec3(0, 1, 0)), place}};
  };
  const MovingCollider moving[] = {
      {Sphere{{0, 0, 0}, 0.05}, {{key(0, 0, {0.3, -0.2, 0}), key(0.1, 0, {0.3, 0.2, 0})}}, false},
      {RoundedBox{{0, -0.03, 0}, glm::dmat3(1), {1, 0.018, 1}, 0.002}, {{key(0, 0, {}), key(1, 2, {})}}, true},
      {ball, {{key(0, 0, {-0.9, 0, 0}), key(0.1, 3, {0.3, 0, 0})}}, false}};
  EffectBlocks effects = gravity_and_colliders("friction=0.5");
  const strands::Groom groom = ring(20);
  const std::string settings = GetParam() == std::string("rod") ? k_slack : "";
  auto cpu = make_solver(GetParam(), groom, settings, effects);
  auto kernel = make_gpu(GetParam(), groom, settings, effects);
  const auto others = next_floats(GetParam(), groom, settings, effects);
  for (int k = 0; k < 3; ++k) {
    FrameInput input = frame_of(k);
    input.colliders = {&k_head, 1};
    input.moving = moving;
    input.clock_begin = k / 30.0;
    input.clock_end = (k + 1) / 30.0;
    ASSERT_TRUE(cpu->advance(input).ok());
    ASSERT_TRUE(kernel->advance(input).ok());
    EXPECT_EQ(kernel->dispatches(input).at(GetParam()), 1u);
    const double apart = worst_distance(cpu->state()->positions, kernel->state()->positions);
    double chaos = 0;
    for (const auto& other : others) {
      ASSERT_TRUE(other->advance(input).ok());
      chaos = std::max(chaos, worst_distance(cpu->state()->positions, other->state()->positions));
    }
    std::printf("%s beside moving colliders, %d frames: CPU and kernel %.1e m apart, CPU from the next floats %.1e m\n",
                GetParam(), k + 1, apart, chaos);
    EXPECT_LT(apart, k == 0 ? 2e-5 : 3 * chaos);  // what is struck trembles: rounding of the start grows as fast
  }
}

TEST_P(ChainGpu, TwoRuns_AreBitIdentical) { expect_bit_identical_runs(GetParam(), mixed()); }

TEST_P(ChainGpu, DispatchesOfAFrame_AreThoseTheRegistryStates) {
  const Effect& effect = **find_effect(GetParam());
  auto solver = make_gpu(GetParam(), ring(4), "", gravity_and_colliders());
  FrameInput input = frame_of(0);
  input.colliders = {&k_head, 1};
  const auto counts = recorded(*solver, input);
  ASSERT_EQ(counts.size(), 1u);
  EXPECT_EQ(counts.at(std::string(GetParam())), effect.entry.dispatches(settings_of(GetParam()), {}));
  EXPECT_TRUE(effect.fuses_effects);
  EXPECT_EQ(solver->dispatches(input).at(GetParam()), 1u);
}

TEST_P(ChainGpu, HardSteps_KeepLengths) {
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, uniform_segments(31, 0.3));
  for (double duration : {0.0, 1e-3, 1.0, 100.0}) {
    const State state =
        run_still(*make_gpu(GetParam(), groom, "clamped_vertices=1,inner_step=100", gravity()), 5, duration);
    EXPECT_TRUE(all_finite(state)) << duration;
    EXPECT_LT(worst_stretch(groom, state), 1e-5) << duration;
  }
}

// Software Vulkan ends all loops of an invocation after 65,535 turns together.
TEST_P(ChainGpu, LongFrameOfALongStrand_IsWalkedToItsEnd) {
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, uniform_segments(80, 0.3));
  const State state = run_still(*make_gpu(GetParam(), groom, "inner_step=0.001", gravity()), 1, 1.0 / 30);
  EXPECT_LT(worst_stretch(groom, state), 1e-5);
}

TEST_P(ChainGpu, Teleport_EqualsTheCpu) {
  // Fused products and estimated reciprocals alone part them; without, as in the units of every x86-64, 3e-8 m.
  expect_teleport_of_the_cpu(GetParam(), GetParam() == std::string("rod") ? k_slack : "", 4.5e-5);
}

TEST_P(ChainGpu, DoublePrecision_IsRefused) {
  const auto settings = settings_of(GetParam(), "double_precision=true");
  EXPECT_FALSE((*find_gpu_effect(GetParam()))->create(device(), ring(1), settings, {}).ok());
}

}  // namespace
}  // namespace cuticle::sim::chain_gpu_test
