// Clumps against the offset and the critically damped approach that they state, at any frame rate; what must not move;
// the stability matrix.
#include "sim/clumping/clumping.h"

#include "sim/chains/test_stability.h"
#include "sim/clumping/test_clumps.h"

namespace cuticle::sim::clumping_test {
namespace {

using namespace testing;

constexpr double k_apart = 0.005;

/// A guide in the middle of two strands of 0.2 m that hang `k_apart` beside it.
strands::Groom three() {
  strands::Groom groom;
  for (double x : {0.0, k_apart, -k_apart}) add_straight(groom, {x, 0, 0}, {0, -1, 0}, uniform_segments(16, 0.2));
  set_clumps(groom, {4, 4, 4});
  return groom;
}

/// Of the second strand's tip from the guide's, over that at rest.
double tip_offset(const State& state) { return double(state.positions[33].x - state.positions[16].x) / k_apart; }

State after(const char* solver, double time, double rate_hz, const std::string& clumps) {
  auto made = make_solver(solver, three(), limp(solver), clumps_alone(clumps));
  return run_still(*made, int(std::lround(time * rate_hz)), 1 / rate_hz);
}

class Clumping : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, Clumping, ::testing::Values("exact", "rod"),
                         [](const auto& info) { return info.param; });

TEST_P(Clumping, Pull_ComesToTheStatedOffsetAtThirtySixtyAndManyFrames) {
  for (double hertz : {30.0, 60.0, 144.0}) {
    const State state = after(GetParam(), 2, hertz, "rate=20,tightness=0.6,profile=2,noise=0");
    double worst = 0;
    for (int i = 1; i <= 16; ++i) {
      const double stated = 1 - 0.6 * (i / 16.0) * (i / 16.0);
      for (std::size_t strand : {1, 2}) {
        const glm::vec3 apart = state.positions[strand * 17 + std::size_t(i)] - state.positions[std::size_t(i)];
        worst = std::max(worst, std::abs(std::abs(double(apart.x)) / k_apart - stated));
      }
    }
    std::printf("%s at %.0f Hz: offset from the stated one by at most %.1e of that at rest\n", GetParam(), hertz,
                worst);
    EXPECT_LT(worst, 0.02);
  }
}

TEST_P(Clumping, Approach_IsCriticallyDampedAtAnyFrameRate) {
  const double rate = 20, time = 1.0 / 6;
  const double truth = 1 - 0.5 * (1 - (1 + rate * time) * std::exp(-rate * time));
  for (double hertz : {30.0, 60.0, 144.0}) {
    const double found = tip_offset(after(GetParam(), time, hertz, "rate=20,tightness=0.5,noise=0"));
    std::printf("%s at %.0f Hz after %.3f s: %.4f of the offset, in truth %.4f\n", GetParam(), hertz, time, found,
                truth);
    EXPECT_NEAR(found, truth, 0.02);
  }
}

TEST_P(Clumping, HeadThatIsTurned_HasItsHairPulledAlike) {
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1), 1.2, glm::dvec3(0, 0.6, 0.8));
  auto upright = make_solver(GetParam(), three(), limp(GetParam()), clumps_alone("rate=20")),
       aslant = make_solver(GetParam(), three(), limp(GetParam()), clumps_alone("rate=20"));
  for (int k = 0; k < 30; ++k) {
    ASSERT_TRUE(upright->advance({.duration = 1.0 / 60}).ok());
    ASSERT_TRUE(aslant->advance({.duration = 1.0 / 60, .head_begin = turned, .head_end = turned}).ok());
  }
  State expected = upright->state().value();
  for (glm::vec3& place : expected.positions) place = turned * glm::dvec4(glm::dvec3(place), 1);
  EXPECT_LT(worst_distance(aslant->state()->positions, expected.positions), 3e-4);  // limp hair buckles by rounding
}

TEST_P(Clumping, RateZeroAndHuge_AreSafe) {
  const State loose = after(GetParam(), 1, 60, "rate=0,tightness=1");
  EXPECT_EQ(loose.guards_fired, 0u);
  EXPECT_NEAR(tip_offset(loose), 1, 1e-5);
  const State stiff = after(GetParam(), 1, 60, "rate=1e9,tightness=1,noise=0");
  EXPECT_TRUE(all_finite(stiff));
  EXPECT_LT(worst_stretch(three(), stiff), 1e-5);
  EXPECT_NEAR(tip_offset(stiff), 0, 0.02);
}

TEST_P(Clumping, ClumpOfOne_MovesAsWithoutTheEffect) {
  strands::Groom groom = ring(5);
  set_clumps(groom, {0, 1, 2, 3, 4});
  const std::string settings = GetParam() == std::string("rod") ? "sag_free=false" : "";
  const State with = run_frames(*make_solver(GetParam(), groom, settings, gravity_and_clumps()), 20),
              without = run_frames(*make_solver(GetParam(), groom, settings, gravity()), 20);
  if (GetParam() == std::string("exact")) {
    EXPECT_EQ(with.positions, without.positions);
  } else {
    EXPECT_LT(worst_distance(with.positions, without.positions), 2e-4);  // drag is weighed in another order
  }
}

TEST_P(Clumping, GuideOutOfBounds_LeadsNobodyAndTouchesNoOther) {
  const strands::Groom good = ring(12);
  strands::Groom mixed = beside_overflow(good);
  set_clumps(mixed, {1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2});
  strands::Groom alone = good;
  set_clumps(alone, {1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2});
  const std::string settings = GetParam() == std::string("rod") ? "sag_free=false" : "";
  const EffectBlocks effects = gravity_and_clumps("noise=0");  // chance is by the strand's number
  auto beside = make_solver(GetParam(), mixed, settings, effects),
       without = make_solver(GetParam(), alone, settings, effects);
  const State state = run_frames(*beside, 20), expected = run_frames(*without, 20);
  EXPECT_TRUE(all_finite(state));
  for (std::size_t i = 3 * 17; i < mixed.vertex_count(); ++i) ASSERT_EQ(state.positions[i], expected.positions[i - 17]);
}

TEST_P(Clumping, HeadTurn_KeepsLengthsAndAgreesAtThirtySixtyAndManyFrames) {
  strands::Groom groom = ring(24);
  std::vector<State> states;
  const std::string settings = GetParam() == std::string("rod") ? "sag_free=false" : "";
  for (double hertz : {30.0, 60.0, 144.0}) {
    auto solver = make_solver(GetParam(), groom, settings, gravity_and_clumps("strands_per_clump=4"));
    for (int k = 0; k < int(hertz / 2); ++k) ASSERT_TRUE(solver->advance(frame_of(k, 1 / hertz)).ok());
    states.push_back(solver->state().value());
    EXPECT_LT(worst_stretch(groom, states.back()), 2e-5);
  }
  for (std::size_t other : {0, 2}) {
    double sum = 0;
    for (std::size_t i = 0; i < groom.vertex_count(); ++i)
      sum += std::pow(glm::distance(glm::dvec3(states[1].positions[i]), glm::dvec3(states[other].positions[i])), 2);
    const double apart = std::sqrt(sum / double(groom.vertex_count())) / 0.3;
    std::printf("%s, clumps in a head turn: %s Hz and 60 Hz %.4f of the length apart (rms)\n", GetParam(),
                other ? "144" : "30", apart);
    EXPECT_LT(apart, 0.02);
  }
}

/// The strand of a row of the stability matrix twice, side by side, as a clump.
strands::Groom twice(strands::Groom groom) {
  const std::size_t count = groom.vertex_count();
  for (std::size_t i = 0; i < count; ++i) groom.positions.push_back(groom.positions[i] + glm::vec3(0, 0, 0.01f));
  groom.offsets.push_back(std::uint32_t(2 * count));
  groom.radii.assign(2 * count, strands::k_default_radius);
  set_clumps(groom, {0, 0});
  return groom;
}

TEST_P(Clumping, EveryShapeStepAndDisturbance_KeepsItsLengths) {
  const bool rod = GetParam() == std::string("rod");
  for (const auto& [shape, groom] : shapes())
    for (int disturbance = 0; disturbance < 4; ++disturbance) {
      double worst = 0;
      for (double duration : k_durations)
        for (const char* rate : {"rate=30", "rate=1e9,tightness=1"})
          worst = std::max(worst, run(GetParam(), twice(groom), rod ? "sag_free=false" : k_free, duration,
                                      Disturbance(disturbance), rod ? 12 : 30, gravity_and_clumps(rate)));
      std::printf("clumping in %s: %-22s %-13s stretch over its bound, steps of 1e-3 .. 100 s: %.2f\n", GetParam(),
                  shape.c_str(), k_names[disturbance], worst);
      EXPECT_LE(worst, 1) << shape << k_names[disturbance];
    }
}

TEST(ClumpGuides, Attribute_MakesClumpsLedFromTheirMiddle) {
  strands::Groom groom;
  for (double x : {0.0, 1.0, 2.0, 10.0, 11.0}) add_straight(groom, {x, 0, 0}, {0, -1, 0}, {0.1});
  set_clumps(groom, {7, 7, 7, 3, NAN});
  const std::vector<std::uint32_t> expected = {1, 1, 1, 3, 4};
  EXPECT_EQ(clumping::guides_of(groom, {}), expected);
}

TEST(ClumpGuides, Chance_MakesOneOfSoManyAGuideAndStrandsFollowTheNearest) {
  const strands::Groom groom = ring(600);
  clumping::Settings settings{.strands_per_clump = 12, .seed = 3};
  const std::vector<std::uint32_t> guides = clumping::guides_of(groom, settings);
  EXPECT_EQ(guides, clumping::guides_of(groom, settings));
  std::vector<std::uint32_t> leaders;
  for (std::uint32_t s = 0; s < guides.size(); ++s)
    if (guides[s] == s) leaders.push_back(s);
  EXPECT_NEAR(double(leaders.size()), 50, 20);
  const auto gap = [&](std::uint32_t a, std::uint32_t b) {
    return glm::distance(groom.strand(a)[0], groom.strand(b)[0]);
  };
  for (std::uint32_t s = 0; s < guides.size(); ++s)
    for (std::uint32_t leader : leaders) ASSERT_LE(gap(s, guides[s]), gap(s, leader));
  settings.seed = 4;
  EXPECT_NE(guides, clumping::guides_of(groom, settings));
}

TEST(ClumpAims, Noise_LoosensEachStrandByItsChance) {
  const strands::Groom groom = ring(40);
  const auto kept = [&](double noise) {  // of strands' offsets at the tip, over those at rest
    chains::Chains<double> chains = chains::make_chains<double>(groom, chains::ChainSettings{});
    const clumping::Settings settings{.rate = 1e6, .tightness = 0.8, .noise = noise, .strands_per_clump = 8, .seed = 0};
    const auto vertices = clumping::join_clumps(chains, groom, settings);
    const auto guides = clumping::guides_of(groom, settings);
    std::vector<double> shares;
    std::size_t last = 0;
    for (std::uint32_t s = 0; s < guides.size(); ++s) {
      if (guides[s] == s) continue;
      last += 16;
      const glm::dvec3 apart(groom.strand(guides[s])[0] - groom.strand(s)[0]);
      const glm::dvec3 rest(groom.strand(s)[16] - groom.strand(guides[s])[16]);
      shares.push_back(glm::length(vertices[last - 1].base - apart) / glm::length(rest));
    }
    return shares;
  };
  const std::vector<double> without = kept(0), with = kept(0.5);
  double least = 1, most = 0;
  for (std::size_t k = 0; k < with.size(); ++k) {
    EXPECT_NEAR(without[k], 0.2, 1e-3);
    least = std::min(least, with[k]), most = std::max(most, with[k]);
  }
  EXPECT_GT(least, 0.2 - 1e-3);  // tightness falls by at most half of itself
  EXPECT_LT(most, 0.6 + 1e-3);
  EXPECT_GT(most - least, 0.2);
}

TEST(ClumpAims, GuideThatIsNoNumber_LeavesTheAimAsItIs) {
  const strands::Groom groom = three();
  chains::Chains<float> chains = chains::make_chains<float>(groom, chains::ChainSettings{});
  const auto vertices = clumping::join_clumps(chains, groom, {.rate = 10, .tightness = 1, .noise = 0});
  ASSERT_EQ(vertices.size(), 32u);
  clumping::aim(chains, vertices, glm::dmat3(1));
  const auto before = chains.rest;
  EXPECT_LT(chains.rest[vertices[15].target], -0.9f * float(k_apart));  // at the tip all of the distance is gone
  chains.state[vertices[7].below] = NAN;
  chains.state[vertices[12].above + 1] = INFINITY;
  clumping::aim(chains, vertices, glm::dmat3(1));
  EXPECT_EQ(before, chains.rest);
}

TEST(ClumpAims, SolversThatCannot_Refuse) {
  EXPECT_FALSE((*find_effect("classic"))->create(three(), settings_of("classic"), gravity_and_clumps()).ok());
  EffectBlocks sleeping = gravity_and_clumps();
  sleeping["sleep"] = settings_of("sleep");
  EXPECT_FALSE((*find_effect("exact"))->create(three(), settings_of("exact"), sleeping).ok());
}

}  // namespace
}  // namespace cuticle::sim::clumping_test
