// The kernels of rigid links on a skin whose places are on the device, against the CPU.
#include "sim/classic/test_gpu.h"
#include "sim/colliders/distance_field.h"
#include "sim/colliders/test_meshes.h"

namespace cuticle::sim::on_skin_gpu_test {
namespace {

using namespace testing;

class OnSkinKernel : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, OnSkinKernel, ::testing::Values("exact", "rod"),
                         [](const auto& info) { return info.param; });

Result<void> advance_on(GpuSolver& kernel, std::span<const glm::vec3> skinned, const FrameInput& input) {
  std::vector<glm::vec4> places;
  for (const glm::vec3& place : skinned) places.emplace_back(place, 0);
  const gpu::Buffer buffer = gpu::make_buffer_from(*device(), std::span<const glm::vec4>(places)).value();
  gpu::Commands commands = device()->record();
  CUTICLE_TRY(kernel.record_on_skin(commands, input, buffer));
  CUTICLE_ASSIGN(const gpu::SubmitCost cost, device()->submit(std::move(commands)));
  EXPECT_EQ(cost.passes.size(), 1u);
  EXPECT_EQ(cost.passes[0].dispatches, 1u);
  return {};
}

TEST_P(OnSkinKernel, Frames_AreThoseOfTheCpu) {
  const strands::Groom groom = ring(12);
  // A limp rod goes any way after a few frames.
  const std::string settings = GetParam() == std::string("rod") ? "sag_free=false,fibre_radius=3e-4" : "";
  auto kernel = make_gpu(GetParam(), groom, settings, gravity());
  auto cpu = make_solver(GetParam(), groom, settings, gravity());
  double apart = 0, speeds = 0, root = 0;
  for (int frame = 0; frame < 20; ++frame) {
    const std::vector<glm::vec3> skinned = on_turning_roots(groom, frame / 30.0 + (frame > 15 ? 3 : 0));
    const FrameInput input{.duration = 1.0 / 30, .teleport = frame == 16};
    const Result<void> advanced = advance_on(*kernel, skinned, input);
    ASSERT_TRUE(advanced.ok()) << advanced.error().message;
    FrameInput same = input;
    same.skinned = skinned;
    ASSERT_TRUE(cpu->advance(same).ok());
    const State a = kernel->state().value(), b = cpu->state().value();
    for (std::size_t s = 0; s < groom.strand_count(); ++s)
      root = std::max(root, double(glm::distance(a.positions[17 * s], skinned[17 * s])));
    if (frame > 3 && frame < 16) continue;  // rounding grows in so wild a motion, until the teleport
    apart = std::max(apart, worst_distance(a.positions, b.positions));
    speeds = std::max(speeds, worst_distance(a.velocities, b.velocities));
  }
  std::printf("%s on a skin, 4 frames, a teleport and 4 more: CPU and GPU %.1e m, %.1e m/s apart, roots %.1e m off\n",
              GetParam(), apart, speeds, root);
  EXPECT_LT(apart, 1e-4);
  EXPECT_LT(speeds, 2e-2);
  EXPECT_EQ(root, 0);
}

TEST_P(OnSkinKernel, HairPutOntoIt_MovesOnAsHairThatIsNew) {
  const strands::Groom groom = curls();
  auto moved = make_gpu(GetParam(), groom, "", gravity()), made = make_gpu(GetParam(), groom, "", gravity());
  for (int frame = 0; frame < 10; ++frame)
    ASSERT_TRUE(advance_on(*moved, on_turning_roots(groom, frame / 30.0), {.duration = 1.0 / 30}).ok());
  for (int frame = 0; frame < 3; ++frame) {
    const std::vector<glm::vec3> skinned = on_turning_roots(groom, 3 + frame / 30.0);
    const FrameInput input{.duration = 1.0 / 30, .teleport = frame == 0};
    ASSERT_TRUE(advance_on(*moved, skinned, input).ok() && advance_on(*made, skinned, input).ok());
    EXPECT_EQ(moved->state()->positions, made->state()->positions) << frame;
  }
}

TEST_P(OnSkinKernel, BesideColliders_FramesAreThoseOfTheCpu) {
  const strands::Groom groom = ring(12);
  const std::string settings = GetParam() == std::string("rod") ? "sag_free=false,fibre_radius=3e-4" : "";
  const Sphere ball{{0.25, -0.02, 0.01}, 0.06};
  const RoundedBox slab{{-0.25, 0, 0}, glm::dmat3(1), {0.05, 0.02, 0.1}, 0.01};
  const FieldPointer mesh = std::make_shared<const DistanceField>(*bake_distance_field(
      strands::transformed(ball_mesh(0.05, 16), glm::translate(glm::dmat4(1), glm::dvec3(0.01, -0.02, 0.25))), 0.01,
      "ball"));
  auto kernel = make_gpu(GetParam(), groom, settings, gravity_and_colliders("friction=1"));
  auto cpu = make_solver(GetParam(), groom, settings, gravity_and_colliders("friction=1")),
       free = make_solver(GetParam(), groom, settings, gravity());
  double apart = 0;
  for (int frame = 0; frame < 5; ++frame) {
    std::vector<glm::vec3> skinned = on_turning_roots(groom, frame / 30.0);
    for (glm::vec3& place : skinned) place += 0.02f * float(frame) * glm::vec3(1, 0, 1);  // rubs along them
    FrameInput input{.duration = 1.0 / 30, .colliders = {&ball, 1}, .boxes = {&slab, 1}, .fields = {&mesh, 1}};
    const Result<void> advanced = advance_on(*kernel, skinned, input);
    ASSERT_TRUE(advanced.ok()) << advanced.error().message;
    input.skinned = skinned;
    ASSERT_TRUE(cpu->advance(input).ok());
    ASSERT_TRUE(free->advance({.duration = 1.0 / 30, .skinned = skinned}).ok());
    apart = std::max(apart, worst_distance(kernel->state()->positions, cpu->state()->positions));
  }
  const double met = worst_distance(kernel->state()->positions, free->state()->positions);
  std::printf("%s beside colliders on a skin, 5 frames: CPU and GPU %.1e m apart, %.3f m from no colliders\n",
              GetParam(), apart, met);
  EXPECT_GT(met, 0.01);
  EXPECT_LT(apart, 4e-4);  // measured: 7.2e-5, 4.5e-6
}

}  // namespace
}  // namespace cuticle::sim::on_skin_gpu_test
