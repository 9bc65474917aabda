// Strand against strand: the grid's sums, what smoothing and pressure do, and that no setting breaks a solver.
#include <algorithm>

#include <tbb/global_control.h>

#include "sim/strand_interaction/test_bundle.h"

namespace cuticle::sim::strand_interaction_test {
namespace {

using namespace testing;

const glm::dmat3 k_as_it_is[] = {glm::dmat3(1)};
using strand_interaction::GridSums;
using strand_interaction::StrandGrid;
using strand_interaction::StrandInteraction;

std::unique_ptr<StrandInteraction> make(const strands::Groom& groom, const std::string& settings) {
  return StrandInteraction::create(groom, interaction_settings(settings)).value();
}
void set(std::span<glm::vec3> to, std::span<const glm::vec3> from) { std::copy(from.begin(), from.end(), to.begin()); }

double largest(std::span<const glm::vec3> vectors) {
  double most = 0;
  for (const glm::vec3& v : vectors) most = std::max(most, double(glm::length(v)));
  return most;
}

TEST(StrandInteraction, Grid_CountsAllMassAndMomentum) {
  const strands::Groom groom = ring(300);
  const StrandGrid grid = strand_interaction::make_strand_grid(groom, 0.02).value();
  const std::vector<glm::vec3> velocities = random_vectors(groom.vertex_count(), 20);
  GridSums sums(grid);
  for (int moment = 0; moment < 2; ++moment) sums.deposit(groom.positions, velocities);
  std::int64_t mass = 0, momentum = 0, grid_mass = 0, grid_momentum = 0;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    mass += 32768 * std::int64_t(grid.masses[i]);
    momentum += 32768 * std::int64_t(grid.masses[i]) * std::int64_t(counted_speed(velocities[i].y));
  }
  for (const strand_interaction::NodeSums& node : sums.nodes()) {
    grid_mass += node.mass;
    grid_momentum += node.momentum[1];
  }
  EXPECT_EQ(grid_mass, mass);
  EXPECT_EQ(grid_momentum, momentum);
  EXPECT_LT(mass / 32768, 1 << 27);
  EXPECT_EQ(sums.left_out(), 0u);
}

TEST(StrandInteraction, UniformVelocity_StaysAsItIs) {
  const strands::Groom groom = ring(300);
  auto interaction = make(groom, "smoothing=1e4,pressure=0");
  const glm::vec3 wind(13.7f, -21.1f, 7.3f);
  for (glm::vec3& velocity : interaction->velocities()) velocity = wind;
  const double change = largest(interaction->changes(k_as_it_is, 1.0 / 60)) / double(glm::length(wind));
  std::printf("uniform velocity changes by %.1e of it\n", change);
  EXPECT_LT(change, 5e-7);
}

TEST(StrandInteraction, Smoothing_KeepsMomentum) {
  const strands::Groom groom = ring(300);
  const std::vector<std::uint32_t> masses = strand_interaction::make_strand_grid(groom, 0.02).value().masses;
  auto interaction = make(groom, "smoothing=60,pressure=0");
  set(interaction->velocities(), random_vectors(groom.vertex_count(), 20));
  const auto changes = interaction->changes(k_as_it_is, 1.0 / 60);
  glm::dvec3 sum(0);
  double moved = 0;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    sum += glm::dvec3(changes[i]) * double(masses[i]);
    moved += double(glm::length(changes[i])) * masses[i];
  }
  std::printf("momentum changes by %.1e of what changed hands\n", glm::length(sum) / moved);
  EXPECT_LT(glm::length(sum) / moved, 2e-6);
}

TEST(StrandInteraction, OpposedVelocities_DecayByTheRateAtAnyFrameRate) {
  strands::Groom groom;
  for (int s = 0; s < 2; ++s) add_straight(groom, {0, 0, 0}, {1, 0, 0}, uniform_segments(8, 0.1));
  for (int frames : {15, 30, 72}) {
    auto interaction = make(groom, "smoothing=3,pressure=0");
    for (std::size_t i = 0; i < groom.vertex_count(); ++i)
      interaction->velocities()[i] = glm::vec3(0, i < 9 ? 2 : -2, 0);
    for (int k = 0; k < frames; ++k) {
      const auto changes = interaction->changes(k_as_it_is, 0.5 / frames);
      for (std::size_t i = 0; i < changes.size(); ++i) interaction->velocities()[i] += changes[i];
    }
    EXPECT_NEAR(interaction->velocities()[4].y, 2 * std::exp(-1.5), 1e-3) << frames;
  }
}

TEST(StrandInteraction, RestPoseInATurnedHead_FeelsNoPressure) {
  const strands::Groom groom = ring(300);
  auto interaction = make(groom, "pressure=100,most_acceleration=1e5");
  const glm::dmat3 turned[] = {glm::dmat3(glm::rotate(glm::dmat4(1), 1.0, glm::dvec3(0, 0, 1)))};
  EXPECT_EQ(largest(interaction->changes(turned, 0.1)), 0);
}

/// Mean distance from the bundle's axis of free vertices that were squeezed to half of it, over that at rest.
double spread_after(double seconds, int frames, const std::string& settings, double* widest = nullptr) {
  const strands::Groom groom = bundle(200, 0.06);
  auto interaction = make(groom, settings);
  const std::span<glm::vec3> places = interaction->places(), velocities = interaction->velocities();
  for (glm::vec3& place : places) place *= glm::vec3(0.5f, 1, 0.5f);
  const float step = float(seconds / frames), kept = std::exp(-30 * step);
  for (int k = 0; k < frames; ++k) {
    const auto changes = interaction->changes(k_as_it_is, double(step));
    for (std::size_t i = 0; i < places.size(); ++i) {
      velocities[i] = (velocities[i] + changes[i]) * kept;
      places[i] += velocities[i] * step;
    }
  }
  double sum = 0, rest = 0, most = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double away = double(glm::length(glm::vec2(places[i].x, places[i].z)));
    sum += away;
    most = std::max(most, away / 0.06);
    rest += double(glm::length(glm::vec2(groom.positions[i].x, groom.positions[i].z)));
  }
  if (widest) *widest = most;
  return sum / rest;
}

TEST(StrandInteraction, SqueezedBundle_ExpandsToItsRestDensityAtAnyFrameRate) {
  EXPECT_NEAR(spread_after(2, 120, "pressure=0"), 0.5, 1e-6);
  for (int rate : {30, 60, 144}) {
    double widest = 0;
    const double spread = spread_after(2, 2 * rate, "pressure=0.5", &widest);
    std::printf("squeezed to half: %.3f of its width after 2 s at %d Hz, widest vertex %.3f of the radius\n", spread,
                rate, widest);
    EXPECT_GT(spread, 0.8);
    EXPECT_LT(spread, 1);
    EXPECT_LT(widest, 1);
  }
}

TEST(StrandInteraction, ExtremeSettings_MoveFreeHairNoFartherThanACellAFrame) {
  for (const char* settings : {"pressure=1e4,most_acceleration=1e5", "pressure=1e4,smoothing=1e4,onset=0.01"}) {
    auto interaction = make(bundle(200, 0.06), settings);
    for (glm::vec3& place : interaction->places()) place *= glm::vec3(0.01f, 1, 0.01f);
    for (double duration : {1e-3, 1.0 / 60, 1.0, 100.0})
      EXPECT_LT(largest(interaction->changes(k_as_it_is, duration)) * duration, 0.04) << settings << duration;
  }
}

TEST(StrandInteraction, WhatIsFarOrFast_IsCountedAndMovesNothing) {
  const strands::Groom groom = ring(20);
  auto interaction = make(groom, "pressure=0");
  interaction->places()[3] = glm::vec3(1e9f, 0, 0);
  interaction->places()[9] = glm::vec3(0, NAN, 0);
  interaction->velocities()[50] = glm::vec3(0, 1e6f, 0);
  const auto changes = interaction->changes(k_as_it_is, 1.0 / 60);
  EXPECT_EQ(interaction->left_out(), 3u);
  EXPECT_EQ(largest(changes.subspan(3, 1)) + largest(changes.subspan(9, 1)), 0);
  EXPECT_LT(largest(changes), 128.1);
}

class InteractingSolver : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, InteractingSolver, ::testing::Values("exact", "rod"),
                         [](const auto& info) { return info.param; });

TEST_P(InteractingSolver, OneAndManyThreads_AreBitIdentical) {
  const strands::Groom groom = ring(100);
  auto many = make_solver(GetParam(), groom, "", gravity_and_interaction());
  const State a = run_frames(*many, 8);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  auto single = make_solver(GetParam(), groom, "", gravity_and_interaction());
  const State b = run_frames(*single, 8);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.velocities, b.velocities);
  auto apart = make_solver(GetParam(), groom, "", gravity());
  EXPECT_GT(worst_distance(run_frames(*apart, 8).positions, a.positions), 1e-3);
}

TEST_P(InteractingSolver, ExtremeSettingsAndSteps_KeepLengths) {
  const strands::Groom groom = bundle(40, 0.02);
  for (const char* settings :
       {"pressure=1e4,smoothing=1e4,most_acceleration=1e5,onset=0.01", "cell=0.005,pressure=50", "cell=10"})
    for (double duration : {1e-3, 1.0 / 60, 1.0, 100.0}) {
      auto solver = make_solver(GetParam(), groom, "max_substeps=8", gravity_and_interaction(settings));
      for (int k = 0; k < 12; ++k) ASSERT_TRUE(solver->advance(frame_of(k, duration)).ok());
      const State state = solver->state().value();
      EXPECT_TRUE(all_finite(state)) << settings << duration;
      const glm::vec3 head(head_at(12 * duration)[3]);
      State relative = state;
      for (glm::vec3& place : relative.positions) place -= head;
      EXPECT_LT(worst_stretch(groom, relative), duration > 2 ? 1e-2 : 1e-3) << settings << duration;
      EXPECT_EQ(state.guards_fired, 0u);
    }
}

TEST_P(InteractingSolver, LooseBundle_HangsWiderThanWithout) {
  strands::Groom groom;  // a crown of slanted strands that gravity draws together
  for (int s = 0; s < 200; ++s) {
    const double away = std::sqrt((s + 0.5) / 200), angle = 2.399963229728653 * s;
    const glm::dvec3 side(std::cos(angle), 0, std::sin(angle));
    add_straight(groom, 0.01 * away * side, glm::normalize(0.7 * away * side - glm::dvec3(0, 1, 0)),
                 uniform_segments(16, 0.2));
  }
  const std::string limp = std::string(GetParam()) == "exact"
                               ? "shape_stiffness=0,clamped_vertices=1"
                               : "young_modulus=0,shear_modulus=0,sag_free=false,clamped_vertices=1";
  const auto width = [&](const EffectBlocks& effects) {
    const State state = run_still(*make_solver(GetParam(), groom, limp, effects), 60, 1.0 / 30);
    double sum = 0;
    for (std::size_t s = 0; s < groom.strand_count(); ++s) {
      const glm::vec3& tip = state.positions[groom.offsets[s + 1] - 1];
      sum += double(glm::length(glm::vec2(tip.x, tip.z))) / 200;
    }
    return sum;
  };
  const double without = width(gravity()), with = width(gravity_and_interaction());
  std::printf("%s: tips hang %.4f m from the axis, %.4f without strand against strand\n", GetParam(), with, without);
  EXPECT_LT(without, 0.012);
  EXPECT_GT(with, 2 * without);
}

TEST(InteractingExact, ThirtySixtyAndManyFrames_Agree) {
  const strands::Groom groom = ring(100);
  const auto after = [&](int rate) {
    auto solver = make_exact(groom, "shape_stiffness=6", gravity_and_interaction());
    for (int k = 0; k < rate / 2; ++k) EXPECT_TRUE(solver->advance(frame_of(k, 1.0 / rate)).ok());
    return solver->state()->positions;
  };
  const std::vector<glm::vec3> middle = after(60);
  for (int rate : {30, 144}) {
    const std::vector<glm::vec3> other = after(rate);
    double sum = 0;
    for (std::size_t i = 0; i < middle.size(); ++i) sum += std::pow(double(glm::distance(middle[i], other[i])), 2);
    const double off = std::sqrt(sum / double(middle.size())) / 0.3;
    std::printf("strand against strand at %d Hz against 60: rms %.4f of the length after 0.5 s\n", rate, off);
    EXPECT_LT(off, 0.02);
  }
}

TEST(InteractingExact, CellTooSmall_IsRefusedByName) {
  const auto made =
      (*find_effect("exact"))->create(ring(4), settings_of("exact"), gravity_and_interaction("cell=0.001"));
  ASSERT_FALSE(made.ok());
  EXPECT_THAT(made.error().message, ::testing::HasSubstr("cell: 0.001 m makes"));
}

TEST(InteractingClassic, IsRefusedByName) {
  const auto made = (*find_effect("classic"))->create(ring(1), settings_of("classic"), gravity_and_interaction());
  ASSERT_FALSE(made.ok());
  EXPECT_THAT(made.error().message, ::testing::HasSubstr("strand_interaction"));
}

}  // namespace
}  // namespace cuticle::sim::strand_interaction_test
