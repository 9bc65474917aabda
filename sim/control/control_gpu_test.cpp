// The blend on the device against that on the CPU, and its one dispatch.
#include "sim/control/control_gpu.h"
#include "sim/classic/test_gpu.h"

namespace cuticle::sim::control_gpu_test {
namespace {

using namespace testing;

TEST(ControlGpu, PositionsAndVelocitiesOnTheDevice_AreThoseOfTheBlendedState) {
  const strands::Groom groom = ring(20);
  auto solver =
      control::controlled_gpu(device(), make_gpu("classic", groom, "", gravity()), groom,
                              registry::from_values<control::Control>(settings_of("control", "root=1,tip=0.25")))
          .value();
  const State state = run_frames(*solver, 5);
  const std::vector<glm::vec4> world =
      gpu::read_buffer<glm::vec4>(*device(), solver->positions(), groom.vertex_count()).value();
  const std::vector<glm::vec3> places(world.begin(), world.end());
  EXPECT_LT(worst_distance(places, state.positions), 1e-7);
  const std::vector<glm::vec4> moving =
      gpu::read_buffer<glm::vec4>(*device(), solver->velocities(), groom.vertex_count()).value();
  const std::vector<glm::vec3> velocities(moving.begin(), moving.end());
  EXPECT_LT(worst_distance(velocities, state.velocities), 1e-6);
  auto free = make_gpu("classic", groom, "", gravity());
  EXPECT_GT(worst_distance(run_frames(*free, 5).positions, state.positions), 0.01);
}

TEST(ControlGpu, OneDispatchMore_AndNoneWithoutTheEffect) {
  const strands::Groom groom = ring(4);
  auto free = make_gpu("exact", groom, "", gravity());
  auto held = control::controlled_gpu(device(), make_gpu("exact", groom, "", gravity()), groom,
                                      registry::from_values<control::Control>(settings_of("control")))
                  .value();
  const auto without = recorded(*free, frame_of(0)), with = recorded(*held, frame_of(0));
  EXPECT_EQ(without.count("control"), 0u);
  EXPECT_EQ(with.at("control"), 1u);
  EXPECT_EQ(with.at("exact"), without.at("exact"));
  EXPECT_EQ(held->dispatches(frame_of(0)).at("control"), 1u);
}

}  // namespace
}  // namespace cuticle::sim::control_gpu_test
