// On a skin: clumps, strand against strand and sleep.
#include "sim/chains/test_stability.h"
#include "sim/clumping/test_clumps.h"
#include "sim/strand_interaction/test_bundle.h"

namespace cuticle::sim::effects_on_skin_test {
namespace {

using namespace testing;

class EffectsOnSkin : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, EffectsOnSkin, ::testing::Values("exact", "rod"),
                         [](const auto& info) { return info.param; });

std::vector<glm::vec3> turned(const strands::Groom& groom, const glm::dmat4& by) {
  std::vector<glm::vec3> places;
  for (const glm::vec3& place : groom.positions) places.emplace_back(by * glm::dvec4(glm::dvec3(place), 1));
  return places;
}

/// The state of a head that moves like this, of hair with these effects, and that of a skin that moves alike.
/// Gravity is none of them: what holds the rest pose against it is of the head's turn, or of every pose of the skin.
std::pair<State, State> on_head_and_skin(const char* solver, const strands::Groom& groom, const EffectBlocks& effects,
                                         int frames) {
  auto on_head = make_solver(solver, groom, "", effects), on_skin = make_solver(solver, groom, "", effects);
  const auto head = [](int frame) {
    return glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(0.01 * frame, 0.02 * std::sin(0.3 * frame), 0)), 0.4,
                       glm::dvec3(0, 0.6, 0.8));
  };
  for (int frame = 0; frame <= frames; ++frame) {
    const double duration = frame > 0 ? 1.0 / 30 : 0;
    EXPECT_TRUE(
        on_head->advance({.duration = duration, .head_begin = head(std::max(0, frame - 1)), .head_end = head(frame)})
            .ok());
    advance_on(*on_skin, turned(groom, head(frame)), duration);
  }
  return {on_head->state().value(), on_skin->state().value()};
}

/// Two strands beside their guide, from whose clump the skin carries one away and turns it. They bend, which tells how.
strands::Groom three() {
  strands::Groom groom;
  for (double x : {0.0, 0.005, -0.005}) {
    for (int i = 0; i <= 16; ++i) groom.positions.emplace_back(x, -0.0125 * i, 1e-4 * i * i);
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), strands::k_default_radius);
  set_clumps(groom, {4, 4, 4});
  return groom;
}

TEST_P(EffectsOnSkin, SkinThatMovesAsAHead_MovesClumpsAsTheHeadDoes) {
  const auto [head, skin] = on_head_and_skin(GetParam(), ring(40), clumps_alone("strands_per_clump=4"), 10);
  const auto [without, unused] = on_head_and_skin(GetParam(), ring(40), {}, 10);
  const double apart = worst_distance(head.positions, skin.positions);
  std::printf("%s, clumps on a skin and on a head that move alike: %.1e m apart\n", GetParam(), apart);
  EXPECT_LT(apart, 5e-5);
  EXPECT_GT(worst_distance(head.positions, without.positions), 1e-3);
}

TEST_P(EffectsOnSkin, SkinThatMovesAsAHead_LetsStrandsMeetAsTheHeadDoes) {
  EffectBlocks meeting = gravity_and_interaction();
  meeting.erase("gravity");
  const auto [head, skin] = on_head_and_skin(GetParam(), bundle(60, 0.02), meeting, 4);
  const auto [without, unused] = on_head_and_skin(GetParam(), bundle(60, 0.02), {}, 4);
  const double apart = worst_distance(head.positions, skin.positions);
  std::printf("%s, strand against strand on a skin and on a head that move alike: %.1e m apart\n", GetParam(), apart);
  EXPECT_LT(apart, 5e-4);  // a vertex that rounding puts across the next 1/32 of a cell feels a step
  EXPECT_GT(worst_distance(head.positions, without.positions), 2e-3);
  EXPECT_EQ(skin.left_out, 0u);
}

// In the frame of its own root a strand keeps the stated share of its offset at rest from the guide.
TEST_P(EffectsOnSkin, ClumpWhoseRootsPart_KeepsTheStatedOffsets) {
  const strands::Groom groom = three();
  const glm::dmat4 parted =
      glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(0.004, 0, 0.003)), 0.3, glm::dvec3(0, 1, 0));
  std::vector<glm::vec3> skinned = groom.positions;
  for (std::size_t i = 17; i < 34; ++i) {
    const glm::dvec3 root(groom.positions[17]);
    skinned[i] = glm::vec3(root + glm::dvec3(parted * glm::dvec4(glm::dvec3(groom.positions[i]) - root, 1)));
  }
  auto solver =
      make_solver(GetParam(), groom, limp(GetParam()), clumps_alone("rate=20,tightness=0.6,profile=1,noise=0"));
  for (int frame = 0; frame < 120; ++frame) advance_on(*solver, skinned, 1.0 / 60);
  const State state = solver->state().value();
  double worst = 0;
  for (std::size_t i = 4; i <= 16; ++i) {  // nearer its root the strand is on its way, which makes it lag along itself
    const glm::dvec3 place(state.positions[17 + i]),
        along = glm::normalize(place - glm::dvec3(state.positions[16 + i]));
    const glm::dvec3 stated =
        glm::dvec3(state.positions[i]) + glm::dmat3(parted) * glm::dvec3(0.005, 0, 0) * (1 - 0.6 * double(i) / 16);
    worst = std::max(worst, glm::length(glm::cross(along, stated - place)));
  }
  std::printf("%s: a strand whose root is carried off its clump is %.1e m from where it belongs\n", GetParam(), worst);
  EXPECT_LT(worst, 5e-4);
  EXPECT_LT(worst_stretch(groom, state), 1e-5);
}

TEST_P(EffectsOnSkin, SkinThatDeforms_KeepsLengthsAndLeavesNobodyOut) {
  EffectBlocks effects = gravity_and_interaction("pressure=5");
  effects["clumping"] = settings_of("clumping", "strands_per_clump=4");
  const strands::Groom groom = ring(60);
  auto solver = make_solver(GetParam(), groom, "", effects);
  for (int frame = 0; frame < 30; ++frame) {
    const std::vector<glm::vec3> skinned = on_turning_roots(groom, frame / 30.0);
    advance_on(*solver, skinned);
    const State state = solver->state().value();
    EXPECT_EQ(state.guards_fired + state.left_out, 0u) << frame;
    EXPECT_LT(worst_stretch(groom, state), 1e-5) << frame;
    for (std::size_t s = 0; s < groom.strand_count(); ++s)
      EXPECT_EQ(state.positions[groom.offsets[s]], skinned[groom.offsets[s]]) << frame;
  }
}

TEST_P(EffectsOnSkin, Teleport_PutsClumpedHairOntoItAtRest) {
  const strands::Groom groom = ring(12);
  auto solver = make_solver(GetParam(), groom, "", clumps_alone("strands_per_clump=3,tightness=0"));
  for (int frame = 0; frame < 10; ++frame) advance_on(*solver, on_turning_roots(groom, frame / 30.0));
  const std::vector<glm::vec3> skinned =
      turned(groom, glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(5, 0, 0)), 0.4, glm::dvec3(0, 0.6, 0.8)));
  ASSERT_TRUE(solver->advance({.duration = 1.0 / 30, .teleport = true, .skinned = skinned}).ok());
  EXPECT_LT(worst_distance(solver->state()->positions, skinned), 1e-5);
}

TEST_P(EffectsOnSkin, StrandsAtRest_SleepUntilTheSkinMovesThem) {
  const strands::Groom groom = ring(20);
  EffectBlocks effects = gravity();
  effects["sleep"] = settings_of("sleep", "time=0.1");
  auto solver = make_solver(GetParam(), groom, GetParam() == std::string("rod") ? "fibre_radius=1e-3" : "", effects);
  std::vector<glm::vec3> skinned = groom.positions;
  const auto asleep_after = [&](int frames) {
    for (int k = 0; k < frames; ++k) advance_on(*solver, skinned, 1.0 / 60);
    return solver->state()->asleep;
  };
  ASSERT_EQ(asleep_after(60), 20u);
  const State before = solver->state().value();
  for (std::size_t i = 7 * 17; i < 8 * 17; ++i) skinned[i] += glm::vec3(0, 0.01f, 0);
  EXPECT_EQ(asleep_after(1), 19u);
  EXPECT_EQ(asleep_after(3), 19u);
  const State moved = solver->state().value();
  for (std::size_t i = 0; i < groom.vertex_count(); ++i)
    EXPECT_EQ(moved.positions[i] == before.positions[i], i / 17 != 7) << i;
  EXPECT_EQ(asleep_after(600), 20u);
}

}  // namespace
}  // namespace cuticle::sim::effects_on_skin_test
