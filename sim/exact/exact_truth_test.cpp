// The exact solver against truths of mechanics, each with its error against the time step (printed).
#include <numbers>

#include <fmt/core.h>

#include "sim/classic/test_strands.h"
#include "sim/reference/chain_reference.h"

namespace cuticle::sim::exact_truth_test {
namespace {

using namespace testing;

constexpr double k_g = 9.80665;
const glm::dvec3 k_gravity(0, -k_g, 0);

strands::Groom one_strand(const std::vector<double>& segments, const glm::dvec3& direction = {1, 0, 0}) {
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, direction, segments);
  return groom;
}
/// One substep of exactly this duration in each frame.
std::string free_at_step(const std::string& more = {}) { return k_free + ",inner_step=100,max_substeps=1" + more; }

double agm(double a, double b) {
  while (std::abs(a - b) > 1e-15 * a) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return a;
}

/// Mean period over `swings`, from crossings of x = 0 of a vertex.
double measured_period(Solver& solver, double step, std::size_t vertex, std::size_t swings = 2) {
  FrameInput input;
  input.duration = step;
  std::vector<double> crossings;
  double previous = 1;
  for (int k = 1; crossings.size() < 2 * swings + 1 && k < 100000; ++k) {
    EXPECT_TRUE(solver.advance(input).ok());
    const double x = double(solver.state()->positions[vertex].x);
    if (previous * x < 0) crossings.push_back(step * (k - std::abs(x) / (std::abs(x) + std::abs(previous))));
    previous = x;
  }
  return (crossings.back() - crossings.front()) / double(swings);
}

double pendulum_error(double amplitude_deg, double step) {
  const double length = 0.2, amplitude = amplitude_deg * std::numbers::pi / 180;
  const double truth = 2 * std::numbers::pi * std::sqrt(length / k_g) / agm(1, std::cos(amplitude / 2));
  const strands::Groom groom = one_strand({length}, {std::sin(amplitude), -std::cos(amplitude), 0});
  auto solver = make_exact(groom, free_at_step(",double_precision=true"), gravity());
  return measured_period(*solver, step, 1) / truth - 1;
}

TEST(ExactTruth, Pendulum_PeriodConvergesWithTheSquareOfTheStep) {
  for (double amplitude : {30.0, 90.0, 150.0}) {
    std::vector<double> errors;
    for (double rate : {120.0, 240.0, 480.0, 960.0}) errors.push_back(pendulum_error(amplitude, 1 / rate));
    std::printf(
        "pendulum, %3.0f deg: relative error of the period at 1/120, 1/240, 1/480, 1/960 s: %.1e %.1e %.1e %.1e\n",
        amplitude, errors[0], errors[1], errors[2], errors[3]);
    EXPECT_LT(std::abs(errors[2]), 1.5e-3) << amplitude;
    EXPECT_LT(std::abs(errors[2]), std::abs(errors[0]) / 8) << amplitude;
  }
}

TEST(ExactTruth, TwoLinks_SwingAtTheFrequenciesOfTheClosedForm) {
  // Masses 1 and 1/2 on equal links: omega^2 l / g = (3 -+ sqrt 3) / 2, with x2 = 2 (2 - omega^2 l / g) x1.
  const double length = 0.1, small = 1e-3;
  for (double sign : {-1.0, 1.0}) {
    const double lambda = (3 + sign * std::sqrt(3.0)) / 2,
                 truth = 2 * std::numbers::pi / std::sqrt(lambda * k_g / length);
    std::vector<double> errors;
    for (double rate : {240.0, 480.0}) {
      strands::Groom groom;
      const double x1 = small, x2 = 2 * (2 - lambda) * small;
      groom.positions = {{0, 0, 0}, glm::vec3(x1, -std::sqrt(length * length - x1 * x1), 0), {}};
      groom.positions[2] =
          groom.positions[1] + glm::vec3(x2 - x1, -std::sqrt(length * length - (x2 - x1) * (x2 - x1)), 0);
      groom.radii.assign(3, strands::k_default_radius);
      groom.offsets = {0, 3};
      auto solver = make_exact(groom, free_at_step(",double_precision=true"), gravity());
      errors.push_back(measured_period(*solver, 1 / rate, 1, 3) / truth - 1);
    }
    std::printf("two links, omega^2 l / g = %.4f: relative error of the period at 1/240, 1/480 s: %.1e %.1e\n", lambda,
                errors[0], errors[1]);
    EXPECT_LT(std::abs(errors[1]), 2e-3);
  }
}

TEST(ExactTruth, FineChain_SwingsAsTheContinuousOne) {
  // Lowest frequency of a hanging chain: j_{0,1} / 2 sqrt(g / L); the mode is J0(j_{0,1} sqrt(1 - s / L)).
  const double length = 0.3, truth = 2 * std::numbers::pi / (1.20241277884789 * std::sqrt(k_g / length));
  strands::Groom groom;
  glm::dvec3 place(0);
  for (int i = 0; i <= 32; ++i) {
    const double x = 1e-3 * std::cyl_bessel_j(0.0, 2.40482555769577 * std::sqrt(1 - i / 32.0));
    if (i > 0) place += glm::dvec3(x - place.x, -std::sqrt(std::pow(length / 32, 2) - std::pow(x - place.x, 2)), 0);
    groom.positions.emplace_back(place);
  }
  groom.radii.assign(33, strands::k_default_radius);
  groom.offsets = {0, 33};
  auto solver = make_exact(groom, free_at_step(",double_precision=true"), gravity());
  const double error = measured_period(*solver, 1.0 / 480, 32) / truth - 1;
  std::printf("32 links, lowest mode: relative error of the period at 1/480 s: %.1e\n", error);
  EXPECT_LT(std::abs(error), 2e-3);
}

TEST(ExactTruth, HangingChain_ComesToRestStraightAndUnstretched) {
  for (const auto& segments : {uniform_segments(32, 0.3), growing_segments(31, 0.3, 8), growing_segments(6, 0.3, 8)}) {
    const strands::Groom groom = one_strand(segments);
    auto solver = make_exact(groom, "damping=5,shape_stiffness=0,clamped_vertices=1", gravity());
    const State state = run_still(*solver, 300, 1.0 / 30);
    const double away = glm::distance(glm::dvec3(state.positions.back()), glm::dvec3(0, -0.3, 0));
    std::printf("hanging, %zu links: tip %.1e m from its place, stretch %.1e\n", segments.size(), away,
                worst_stretch(groom, state));
    EXPECT_LT(away, 1e-5) << segments.size();
    EXPECT_LT(worst_stretch(groom, state), 1e-5) << segments.size();
  }
}

TEST(ExactTruth, WindTiltedChain_IsAStraightLine) {
  for (const auto& segments : {uniform_segments(32, 0.3), growing_segments(12, 0.3, 8)}) {
    const strands::Groom groom = one_strand(segments, {0, -1, 0});
    EffectBlocks effects = gravity();
    effects["wind"] = settings_of("wind", "velocity=4/0/0,drag=2,gust=0");
    auto solver = make_exact(groom, k_free, effects);
    const State state = run_still(*solver, 600, 1.0 / 30);
    const glm::dvec3 truth = glm::normalize(glm::dvec3(8, -k_g, 0));
    double worst = 0;
    for (const glm::vec3& place : state.positions)
      worst = std::max(worst, glm::length(glm::cross(glm::dvec3(place), truth)) / 0.3);
    std::printf("wind across %zu links: farthest from the line tan phi = c U / g: %.1e of the length\n",
                segments.size(), worst);
    EXPECT_LT(worst, 1e-3);
  }
}

/// The root at rest, or on a cycloid that starts smoothly (3.2 m/s^2): the strand leaves its plane.
glm::dvec3 root_at(double time, bool moves) {
  return moves ? glm::dvec3(0.05 * (1 - std::cos(8 * time)), 0, 0.05 * (8 * time - std::sin(8 * time))) : glm::dvec3(0);
}
glm::dvec3 root_acceleration(double time, bool moves) {
  return moves ? 3.2 * glm::dvec3(std::cos(8 * time), 0, std::sin(8 * time)) : glm::dvec3(0);
}

/// Root-mean-square distance over the length from the reference at 0.2 and 0.5 s; `substeps` in 1/60 s, each a frame of
/// its own.
std::array<double, 2> motion_errors(const std::vector<double>& segments, bool moves, int substeps) {
  auto solver = make_exact(one_strand(segments), free_at_step(), gravity());
  ReferenceChain truth = make_reference_chain(segments, {1, 0, 0}, {0, 0, 0}, k_gravity);
  std::array<double, 2> errors{};
  const double h = 1.0 / 60 / substeps;
  const int pieces = 512 / substeps;
  for (int k = 1; k <= 30 * substeps; ++k) {
    const glm::dmat4 begin = glm::translate(glm::dmat4(1), root_at((k - 1) * h, moves)),
                     end = glm::translate(glm::dmat4(1), root_at(k * h, moves));
    EXPECT_TRUE(solver->advance({.duration = h, .head_begin = begin, .head_end = end, .colliders = {}}).ok());
    for (int piece = 0; piece < pieces; ++piece) {
      truth.gravity = k_gravity - root_acceleration((k - 1 + (piece + 0.5) / pieces) * h, moves);
      advance_reference(truth, h / pieces, 1);
    }
    if (k != 12 * substeps && k != 30 * substeps) continue;
    const State state = solver->state().value();
    double sum = 0;
    for (std::size_t i = 1; i < state.positions.size(); ++i) {
      const glm::dvec3 away = glm::dvec3(state.positions[i] - state.positions[0]) - truth.places[i - 1];
      sum += glm::dot(away, away);
    }
    errors[k == 30 * substeps] = std::sqrt(sum / double(segments.size())) / 0.3;
  }
  return errors;
}

TEST(ExactTruth, Motion_FollowsTheReference) {
  for (const auto& [name, segments] :
       {std::pair("32 uniform", uniform_segments(32, 0.3)), std::pair("31, 1:8", growing_segments(31, 0.3, 8))})
    for (bool moves : {false, true}) {
      std::printf("%-10s %s, rms / L at 0.2 s, 0.5 s by substeps in 1/60 s:", name,
                  moves ? "moving root" : "swing      ");
      for (int substeps : {4, 8, 16}) {
        const auto [early, late] = motion_errors(segments, moves, substeps);
        std::printf("  %d: %.4f %.4f", substeps, early, late);
        if (substeps != 8) continue;
        EXPECT_LT(early, 0.0015);
        EXPECT_LT(late, moves ? 0.06 : 0.02);
      }
      std::printf("\n");
    }
}

TEST(Reference, HalfTheStep_ChangesNothing) {
  ReferenceChain coarse = make_reference_chain(uniform_segments(32, 0.3), {1, 0, 0}, {0, 0, 0}, k_gravity),
                 fine = coarse;
  const double before = energy_of(fine.lengths, fine.places, fine.velocities, k_gravity);
  advance_reference(coarse, 1.0 / 60 / 512, 512 * 30);
  advance_reference(fine, 1.0 / 60 / 1024, 1024 * 30);
  double worst = 0;
  for (std::size_t i = 0; i < fine.places.size(); ++i)
    worst = std::max(worst, glm::distance(coarse.places[i], fine.places[i]) / 0.3);
  std::printf("reference: half the step changes %.1e of the length, energy %.1e m^2/s^2\n", worst,
              energy_of(fine.lengths, fine.places, fine.velocities, k_gravity) - before);
  EXPECT_LT(worst, 1e-5);
}

TEST(ExactTruth, FallingHead_LeavesItsHairInShape) {
  const strands::Groom groom = one_strand(growing_segments(8, 0.3, 8), {0.6, 0.8, 0});
  for (double h : {1.0 / 60, 1.0 / 480}) {
    auto solver = make_exact(groom, free_at_step(), gravity());
    const auto fallen = [&](int k) {
      return glm::translate(glm::dmat4(1), glm::dvec3(0, -0.5 * k_g * h * h * k * k, 0));
    };
    FrameInput input;
    input.duration = h;
    const int frames = int(std::lround(0.5 / h));
    for (int k = 0; k < frames; ++k) {
      input.head_begin = fallen(k);
      input.head_end = fallen(k + 1);
      ASSERT_TRUE(solver->advance(input).ok());
    }
    const State state = solver->state().value();
    double worst = 0;
    for (std::size_t i = 0; i < groom.vertex_count(); ++i)
      worst = std::max(worst, double(glm::distance(state.positions[i] - state.positions[0], groom.positions[i])));
    std::printf("free fall for 0.5 s at 1/%.0f s: shape lost by %.1e m\n", 1 / h, worst);
    EXPECT_LT(worst, 0.02) << h;
  }
}

/// Its farthest vertex from its shape after half a second of fall, over its length.
double shape_lost(std::string_view name, const std::string& limp, double step) {
  const strands::Groom groom = one_strand(uniform_segments(31, 0.3), {0.6, -0.8, 0});
  auto solver = make_solver(
      name, groom, fmt::format("damping=0,sag_free=false,max_substeps=1,inner_step={}{}", step, limp), gravity());
  const auto fallen = [&](int k) {
    return glm::translate(glm::dmat4(1), glm::dvec3(0, -0.5 * k_g * step * step * k * k, 0));
  };
  const int frames = int(std::lround(0.5 / step));
  for (int k = 0; k < frames; ++k) {
    const FrameInput input{.duration = step, .head_begin = fallen(k), .head_end = fallen(k + 1)};
    EXPECT_TRUE(solver->advance(input).ok());
  }
  const State state = solver->state().value();
  double worst = 0;
  for (std::size_t i = 0; i < groom.vertex_count(); ++i)
    worst = std::max(worst, glm::distance(glm::dvec3(state.positions[i]) - glm::dvec3(fallen(frames)[3]),
                                          glm::dvec3(groom.positions[i])));
  return worst / 0.3;
}

TEST(ExactTruth, FallingHead_ShortStepsLoseNoShapeToRounding) {
  for (const double rate : {1000.0, 2000.0, 8000.0}) {
    const double exact = shape_lost("exact", ",shape_stiffness=0,clamped_vertices=1", 1 / rate),
                 rod = shape_lost("rod", ",young_modulus=0,shear_modulus=0", 1 / rate);
    std::printf("free fall for 0.5 s at 1/%.0f s: exact %.1e, rod %.1e of the length lost\n", rate, exact, rod);
    EXPECT_LT(exact, 1e-4) << rate;  // in float .0015 to .1
    EXPECT_LT(rod, 1e-4) << rate;    // in float .0023 to .043
  }
}

TEST(ExactTruth, NoGravity_AngularMomentumAboutTheRootIsKept) {
  const std::vector<double> segments = uniform_segments(16, 0.3);
  const strands::Groom groom = one_strand(segments);
  auto solver = make_exact(groom, k_free, {});
  const auto momentum = [&](const State& state, const glm::dvec3& drift) {
    glm::dvec3 sum(0);
    for (std::size_t i = 1; i < state.positions.size(); ++i)
      sum += glm::cross(glm::dvec3(state.positions[i] - state.positions[0]), glm::dvec3(state.velocities[i]) - drift) *
             (i + 1 < state.positions.size() ? 1.0 : 0.5);
    return sum;
  };
  FrameInput input;
  glm::dvec3 first(0);
  double worst = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const auto at = [](int k) { return glm::translate(glm::dmat4(1), glm::dvec3(0, 0.2, 0.5) * (k / 60.0)); };
    input.head_begin = at(frame);
    input.head_end = at(frame + 1);
    ASSERT_TRUE(solver->advance(input).ok());
    const glm::dvec3 now = momentum(*solver->state(), {0, 0.2, 0.5});
    if (frame == 0) first = now;
    worst = std::max(worst, glm::distance(now, first) / glm::length(first));
  }
  std::printf("angular momentum about a root in uniform motion: changes by %.1e in 1 s\n", worst);
  EXPECT_LT(worst, 0.02);
}

TEST(ExactTruth, TurnedScene_MovesTurned) {
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 1.1, glm::normalize(glm::dvec3(1, 2, 3)));
  const strands::Groom groom = ring(20);
  auto plain = make_exact(groom, "", gravity());
  EffectBlocks turned_gravity{{"gravity", gravity().at("gravity")}};
  const glm::dvec3 down(turn * glm::dvec4(k_gravity, 0));
  turned_gravity["gravity"] = settings_of("gravity", "acceleration=" + std::to_string(down.x) + "/" +
                                                         std::to_string(down.y) + "/" + std::to_string(down.z));
  strands::Groom turned_groom = groom;
  for (glm::vec3& place : turned_groom.positions) place = glm::vec3(turn * glm::dvec4(place, 1));
  auto turned = make_exact(turned_groom, "", turned_gravity);
  for (int k = 0; k < 15; ++k) {
    FrameInput input = frame_of(k);
    ASSERT_TRUE(plain->advance(input).ok());
    input.head_begin = turn * input.head_begin * glm::inverse(turn);
    input.head_end = turn * input.head_end * glm::inverse(turn);
    ASSERT_TRUE(turned->advance(input).ok());
  }
  State expected = plain->state().value();
  for (glm::vec3& place : expected.positions) place = glm::vec3(turn * glm::dvec4(place, 1));
  const double worst = worst_distance(expected.positions, turned->state()->positions);
  std::printf("a turned scene after 0.5 s: differs by %.1e m\n", worst);
  EXPECT_LT(worst, 1e-3);
}

TEST(ExactTruth, TeleportThenStep_IsStepThenTransform) {
  const glm::dmat4 far = glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(40, -20, 10)), 0.8, glm::dvec3(0, 1, 0));
  const strands::Groom groom = ring(8);
  auto here = make_exact(groom, "", gravity()), there = make_exact(groom, "", gravity());
  run_frames(*here, 5);
  run_frames(*there, 5);
  const glm::dmat4 head = frame_of(4).head_end;
  ASSERT_TRUE(
      there->advance({.duration = 0, .head_begin = head, .head_end = far * head, .colliders = {}, .teleport = true})
          .ok());
  for (int k = 0; k < 5; ++k) {
    ASSERT_TRUE(here->advance({.head_begin = head, .head_end = head, .colliders = {}}).ok());
    ASSERT_TRUE(there->advance({.head_begin = far * head, .head_end = far * head, .colliders = {}}).ok());
  }
  State expected = here->state().value();
  for (glm::vec3& place : expected.positions) place = glm::vec3(far * glm::dvec4(place, 1));
  EXPECT_LT(worst_distance(expected.positions, there->state()->positions),
            1e-4);  // the world position itself rounds to 4e-6
}

TEST(ExactTruth, WithoutInput_EnergyNeverGrows) {
  for (double step : {1e-3, 1.0 / 240, 1.0 / 60, 0.1}) {
    const std::vector<double> segments = uniform_segments(31, 0.3);
    auto solver = make_exact(one_strand(segments), free_at_step(), gravity());
    double highest = -1e9, lowest = 1e9, first = 0;
    for (int k = 0; k < 600; ++k) {
      const State state = run_still(*solver, 1, step);
      const double energy =
          energy_of(segments, std::vector<glm::dvec3>(state.positions.begin() + 1, state.positions.end()),
                    std::vector<glm::dvec3>(state.velocities.begin() + 1, state.velocities.end()), k_gravity) /
          (k_g * 0.3);
      if (k == 0) first = energy;
      highest = std::max(highest, energy - std::min(lowest, first));
      lowest = std::min(lowest, energy);
    }
    std::printf("energy of a swing at %.4f s: largest growth %.1e g L, last %.3f g L\n", step, highest, lowest);
    EXPECT_LT(highest, 0.03) << step;
  }
}

TEST(ExactTruth, ThirtySixtyAndManyFrames_Agree) {
  const strands::Groom groom = ring(32);
  std::vector<State> states;
  for (double rate : {30.0, 60.0, 144.0}) {
    auto solver = make_exact(groom, "", gravity());
    for (int k = 0; k < int(rate / 2); ++k) EXPECT_TRUE(solver->advance(frame_of(k, 1 / rate)).ok());
    states.push_back(solver->state().value());
  }
  for (std::size_t k : {0, 2}) {
    double sum = 0;
    for (std::size_t i = 0; i < groom.vertex_count(); ++i)
      sum += std::pow(double(glm::distance(states[k].positions[i], states[1].positions[i])), 2);
    const double rms = std::sqrt(sum / double(groom.vertex_count())) / 0.3;
    std::printf("%s Hz against 60 Hz after 0.5 s: rms %.4f of the length\n", k ? "144" : "30", rms);
    EXPECT_LT(rms, 0.02);
  }
}

}  // namespace
}  // namespace cuticle::sim::exact_truth_test
