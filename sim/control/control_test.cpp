// Manual control: the blend, its weights over hair, vertex and time, and that the simulation runs on beneath.
#include "sim/control/control.h"
#include "sim/classic/test_strands.h"

namespace cuticle::sim::control_test {
namespace {

using namespace testing;

std::unique_ptr<Solver> with_control(const strands::Groom& groom, const std::string& settings) {
  return control::controlled(make_exact(groom, "", gravity()), groom,
                             registry::from_values<control::Control>(settings_of("control", settings)));
}
std::vector<glm::vec3> carried(const strands::Groom& groom, const glm::dmat4& head) {
  std::vector<glm::vec3> places;
  for (const glm::vec3& place : groom.positions) places.emplace_back(head * glm::dvec4(place, 1));
  return places;
}

TEST(Control, WeightsOfAHairAndVertex_AreTheShareOfTheAuthoredMotion) {
  const strands::Groom groom = ring(3);
  auto free = make_exact(groom, "", gravity()), held = with_control(groom, "root=1,tip=1");
  std::vector<float> weights(groom.vertex_count());
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = float(i % 5) / 4;
  for (int k = 0; k < 10; ++k) {
    FrameInput input = frame_of(k);
    ASSERT_TRUE(free->advance(input).ok());
    input.control = weights;
    ASSERT_TRUE(held->advance(input).ok());
  }
  const std::vector<glm::vec3> authored = carried(groom, frame_of(9).head_end);
  const State simulated = free->state().value(), state = held->state().value();
  for (std::size_t i = 0; i < weights.size(); ++i)
    EXPECT_LT(glm::distance(state.positions[i], glm::mix(simulated.positions[i], authored[i], weights[i])), 1e-6f) << i;
}

TEST(Control, AuthoredMotionGiven_FullWeightIsThatMotionAndItsVelocity) {
  const strands::Groom groom = ring(2);
  auto solver = with_control(groom, "root=1,tip=1");
  std::vector<glm::vec3> places = groom.positions;
  for (int k = 0; k < 5; ++k) {
    for (glm::vec3& place : places) place += glm::vec3(0.01f, 0, 0);
    FrameInput input = frame_of(k);
    input.authored = places;
    ASSERT_TRUE(solver->advance(input).ok());
  }
  const State state = solver->state().value();
  EXPECT_LT(worst_distance(state.positions, places), 1e-7);
  for (const glm::vec3& velocity : state.velocities) EXPECT_LT(glm::distance(velocity, glm::vec3(0.3f, 0, 0)), 1e-4f);
}

TEST(Control, WeightThatFadesOut_LeavesTheSimulationAsIfItHadNeverActed) {
  const strands::Groom groom = ring(3);
  auto free = make_exact(groom, "", gravity()), held = with_control(groom, "root=1,tip=1,begin=0,end=0.2,fade=0.1");
  run_frames(*held, 3);
  EXPECT_LT(worst_distance(held->state()->positions, carried(groom, frame_of(2).head_end)), 1e-6);
  auto again = with_control(groom, "root=1,tip=1,begin=0,end=0.2,fade=0.1");
  EXPECT_EQ(run_frames(*again, 15).positions, run_frames(*free, 15).positions);
}

TEST(Control, VelocityWhileTheWeightChanges_IsTheDerivativeOfThePlace) {
  const strands::Groom groom = ring(2);
  auto solver = with_control(groom, "root=1,tip=1,begin=10,end=10,fade=10");
  const double step = 1e-3;
  std::vector<glm::vec3> before;
  for (int k = 0; k < 400; ++k) {
    if (k == 399) before = solver->state()->positions;
    ASSERT_TRUE(solver->advance(frame_of(k, step)).ok());
  }
  const State state = solver->state().value();
  double worst = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    worst = std::max(worst, double(glm::distance(state.velocities[i], (state.positions[i] - before[i]) / float(step))));
  std::printf("velocity against the change of place: %.2e m/s\n", worst);
  EXPECT_LT(worst, 0.02);
}

TEST(Control, PaintedGroom_ControlsSomeHairsOnly) {
  strands::Groom groom = ring(2);
  groom.attributes["control"] = {strands::Attribute::Domain::strand, 1, {0, 1}};
  auto free = make_exact(groom, "", gravity()), held = with_control(groom, "root=1,tip=1");
  const State a = run_frames(*free, 5), b = run_frames(*held, 5);
  const std::vector<glm::vec3> authored = carried(groom, frame_of(4).head_end);
  const std::size_t second = groom.offsets[1];
  for (std::size_t i = 0; i < groom.vertex_count(); ++i)
    EXPECT_LT(glm::distance(b.positions[i], i < second ? a.positions[i] : authored[i]), 1e-6f) << i;
}

TEST(Control, InputThatDoesNotFit_IsRefusedByNameAndChangesNothing) {
  const strands::Groom groom = ring(2);
  auto solver = with_control(groom, "");
  const std::vector<float> few{0.5f}, over(groom.vertex_count(), 1.5f);
  const std::vector<glm::vec3> broken(groom.vertex_count(), glm::vec3(std::nanf("")));
  FrameInput input = frame_of(0);
  input.control = few;
  EXPECT_THAT(solver->advance(input).error().message, ::testing::HasSubstr("control: 1 entries for 34 vertices"));
  input.control = over;
  EXPECT_THAT(solver->advance(input).error().message, ::testing::HasSubstr("control[0]: 1.5"));
  input.control = {};
  input.authored = broken;
  EXPECT_THAT(solver->advance(input).error().message, ::testing::HasSubstr("authored[0]: component 0"));
  EXPECT_LT(worst_distance(solver->state()->positions, groom.positions), 1e-7);
}

}  // namespace
}  // namespace cuticle::sim::control_test
