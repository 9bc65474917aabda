// Strands at rest are left as they are, bit for bit, and wake with the first frame in which anything changes.
#include <functional>

#include "sim/chains/guard.h"
#include "sim/chains/sleepers.h"
#include "sim/classic/test_strands.h"
#include "sim/colliders/distance_field.h"
#include "sim/colliders/test_meshes.h"
#include "sim/exact/exact.h"

namespace cuticle::sim::sleep_test {
namespace {

using namespace testing;

EffectBlocks with_sleep(EffectBlocks effects, const std::string& settings = {}) {
  effects["sleep"] = settings_of("sleep", settings);
  return effects;
}

class Sleep : public ::testing::TestWithParam<const char*> {
 protected:
  /// Rods that can stand up by themselves: limp ones that balance a slanted rest pose part from it by rounding.
  std::unique_ptr<Solver> make(const strands::Groom& groom, const EffectBlocks& effects) const {
    const std::string settings = GetParam() == std::string("rod") ? "damping=20,fibre_radius=1e-3" : "damping=20";
    return make_solver(GetParam(), groom, settings, effects);
  }
};
INSTANTIATE_TEST_SUITE_P(Solvers, Sleep, ::testing::Values("exact", "rod"),
                         [](const auto& info) { return info.param; });

TEST_P(Sleep, StrandsAtRest_SleepAfterTheTimeAndStayBitForBit) {
  const strands::Groom groom = ring(40);
  auto solver = make(groom, with_sleep(gravity(), "time=0.5"));
  EXPECT_EQ(run_still(*solver, 29, 1.0 / 60).asleep, 0u);
  const State first = run_still(*solver, 4, 1.0 / 60), later = run_still(*solver, 100, 1.0 / 60);
  EXPECT_EQ(first.asleep, 40u);
  EXPECT_EQ(later.asleep, 40u);
  EXPECT_EQ(first.positions, later.positions);
  for (const glm::vec3& velocity : later.velocities) EXPECT_EQ(velocity, glm::vec3(0));
  EXPECT_LT(worst_distance(groom.positions, later.positions), 1e-4);
}

TEST_P(Sleep, AnyChange_WakesWithItsFrame) {
  const Sphere ball{{5, 0, 0}, 0.1}, moved{{5, 1e-6, 0}, 0.1};
  const RoundedBox box{{5, 0, 0}, glm::dmat3(1), {1, 1, 1}, 0};
  const strands::Mesh far = strands::transformed(box_mesh(glm::dvec3(1)), glm::translate(glm::dmat4(1), {5, 0, 0}));
  const FieldPointer field = std::make_shared<const DistanceField>(bake_distance_field(far, 0.5, "far").value());
  const std::function<void(FrameInput&)> changes[] = {
      [](FrameInput& f) { f.head_end = glm::translate(glm::dmat4(1), glm::dvec3(1e-6, 0, 0)); },
      [](FrameInput& f) { f.head_begin = f.head_end = glm::translate(glm::dmat4(1), glm::dvec3(1, 0, 0)); },
      [](FrameInput& f) { f.teleport = true; },
      [](FrameInput& f) { f.duration = 0; },
      [](FrameInput& f) { f.colliders = {}; },
      [&](FrameInput& f) {
        f.colliders = {&moved, 1};
      },
      [&](FrameInput& f) {
        f.boxes = {&box, 1};
      },
      [&](FrameInput& f) {
        f.fields = {&field, 1};
      },
  };
  for (const auto& change : changes) {
    auto solver = make(ring(20), with_sleep(gravity_and_colliders(), "time=0.1"));
    ASSERT_EQ(run_still(*solver, 20, 1.0 / 60, {&ball, 1}).asleep, 20u);
    FrameInput input{.colliders = {&ball, 1}};
    change(input);
    ASSERT_TRUE(solver->advance(input).ok());
    EXPECT_EQ(solver->state()->asleep, 0u) << &change - changes;
  }
}

TEST_P(Sleep, ColliderThatMovesByItself_WakesWhenItStarts) {
  const MovingCollider moving{
      Sphere{{5, 0, 0}, 0.1}, {{{1, {.position = {0, 0, 0}}}, {2, {.position = {1e-3, 0, 0}}}}}, false};
  auto solver = make(ring(20), with_sleep(gravity_and_colliders(), "time=0.1"));
  for (int k = 0; k < 70; ++k) {
    ASSERT_TRUE(solver->advance({.moving = {&moving, 1}, .clock_begin = k / 60.0, .clock_end = (k + 1) / 60.0}).ok());
    if (k < 20) continue;
    EXPECT_EQ(solver->state()->asleep, k < 60 ? 20u : 0u) << k;
  }
}

TEST_P(Sleep, ColliderThatMoves_WakesTheStrandsThatItMayReach) {
  const strands::Groom groom = ring(40);
  const EffectBlocks effects = with_sleep(gravity_and_colliders(), "time=0.1");
  auto solver = make(groom, effects);
  std::vector<std::uint8_t> reached(40, 0);
  for (std::size_t s : {3u, 17u, 39u}) reached[s] = 1;
  Sphere ball{{5, 0, 0}, 0.1};
  const auto frame = [&] {
    EXPECT_TRUE(solver->advance({.colliders = {&ball, 1}, .reached = reached}).ok());
    return *solver->state();
  };
  for (int k = 0; k < 20; ++k) frame();
  const State asleep = frame();
  ASSERT_EQ(asleep.asleep, 40u);
  ball.center.x = 4;
  const State woken = frame();
  EXPECT_EQ(woken.asleep, 37u);
  for (std::size_t s = 0; s < 40; ++s)
    for (std::size_t i = groom.offsets[s]; i < groom.offsets[s + 1] && !reached[s]; ++i)
      EXPECT_EQ(asleep.positions[i], woken.positions[i]) << s;
  reached.assign(40, 0);
  ball.center.x = 3;
  EXPECT_EQ(frame().asleep, 37u) << "the ball leaves what it may have touched";
  ball.center.x = 2;
  for (int k = 0; k < 20; ++k) frame();
  EXPECT_EQ(frame().asleep, 40u);
}

TEST_P(Sleep, GustsKeepAwake_SteadyAirDoesNot) {
  for (const bool gusts : {false, true}) {
    EffectBlocks effects = with_sleep(gravity(), "time=0.2");
    effects["wind"] = settings_of("wind", gusts ? "velocity=0.1/0/0" : "velocity=0.1/0/0,gust=0");
    const State state = run_still(*make(ring(20), effects), 300, 1.0 / 60);
    EXPECT_EQ(state.asleep, gusts ? 0u : 20u);
  }
}

TEST_P(Sleep, Waking_GivesNoJump) {
  const strands::Groom groom = ring(20);
  const Sphere far{{5, 0, 0}, 0.1}, farther{{6, 0, 0}, 0.1};
  auto solver = make(groom, with_sleep(gravity_and_colliders()));
  const State asleep = run_still(*solver, 240, 1.0 / 60, {&far, 1});
  ASSERT_EQ(asleep.asleep, 20u);
  const State awake = run_still(*solver, 1, 1.0 / 60, {&farther, 1});
  EXPECT_EQ(awake.asleep, 0u);
  const double first = worst_distance(asleep.positions, awake.positions);
  double fastest = 0;
  for (const glm::vec3& velocity : awake.velocities) fastest = std::max(fastest, double(glm::length(velocity)));
  std::printf("%s woken: moves %.1e m in the first frame, %.1e m/s\n", GetParam(), first, fastest);
  EXPECT_LT(first, 2e-5);
  EXPECT_LT(fastest, 2e-3);
}

// Sixteen strands make a block, in which all but one are slow enough; left alone they would swing on.
TEST_P(Sleep, StrandThatSwingsAmongSleepers_MovesAsIfNobodySlept) {
  strands::Groom groom;
  for (int s = 0; s < 16; ++s)
    add_straight(groom, {0.01 * s, 0, 0}, s == 5 ? glm::dvec3(1, 0, 0) : glm::normalize(glm::dvec3(0.1, -1, 0)),
                 uniform_segments(8, 0.2));
  const std::string settings = std::string(GetParam()) == "exact" ? k_free : "damping=0,sag_free=false";
  auto apart = make_solver(GetParam(), groom, settings, gravity());
  auto solver = make_solver(GetParam(), groom, settings, with_sleep(gravity(), "time=0.2,speed=0.5"));
  const State before = run_still(*solver, 30, 1.0 / 60), after = run_still(*solver, 30, 1.0 / 60),
              expected = run_still(*apart, 60, 1.0 / 60);
  EXPECT_EQ(after.asleep, 15u);
  for (std::size_t i = 0; i < groom.vertex_count(); ++i)
    if (i / 9 == 5)
      EXPECT_EQ(after.positions[i], expected.positions[i]);
    else
      EXPECT_EQ(after.positions[i], before.positions[i]);
  EXPECT_GT(worst_distance(after.positions, before.positions), 0.01);
}

TEST(SleepingStrands, ResetInAFrame_StayAwakeInIt) {
  const chains::ChainSettings settings = exact::make_settings(settings_of("exact"), with_sleep(gravity(), "time=0.5"));
  chains::Chains<float> chains = chains::make_chains<float>(ring(16), settings);
  chains.strand_at(0, chains::strand_row::guarded)[3] = float(chains::k_was_reset);
  chains::Sleepers<float> sleepers(*settings.sleep);
  EXPECT_TRUE(sleepers.begin(chains, 0, 0, {}));
  sleepers.end(chains, 0, 1, {});
  EXPECT_EQ(sleepers.count(chains), 15u);
  EXPECT_EQ(chains.strand_at(0, chains::strand_row::quiet)[3], 0.f);
}

TEST(SleepingStrands, ThatInteract_AreRefusedByName) {
  EffectBlocks effects = with_sleep(gravity());
  effects["strand_interaction"] = settings_of("strand_interaction");
  for (const char* solver : {"exact", "classic"}) {
    const auto made = (*find_effect(solver))->create(ring(1), settings_of(solver), effects);
    ASSERT_FALSE(made.ok());
    EXPECT_THAT(made.error().message, ::testing::HasSubstr("sleep"));
  }
}

}  // namespace
}  // namespace cuticle::sim::sleep_test
