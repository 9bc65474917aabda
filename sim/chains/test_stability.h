#pragma once
// The stability matrix and the balls that the tests of the solvers of rigid links share.
#include <random>

#include "sim/classic/test_strands.h"

namespace cuticle::sim::testing {

inline const std::vector<double> k_durations = {1e-3, 1.0 / 60, 0.1, 1, 100};

/// One substep a frame, whatever its duration.
inline std::string settings(const std::string& more) { return "inner_step=100,max_substeps=1," + more; }

/// Largest |ratio - 1| over its bound max(1e-5, 4 2^-24 L / l), and length of segments without rest length over 1e-7 L.
inline double worst_over_bound(const strands::Groom& rest, const State& state) {
  double worst = 0;
  for (std::size_t s = 0; s < rest.strand_count(); ++s) {
    double total = 0;
    const auto length = [&](std::span<const glm::vec3> places, std::size_t i) {
      return glm::distance(glm::dvec3(places[i - 1]), glm::dvec3(places[i]));
    };
    for (std::size_t i = rest.offsets[s] + 1; i < rest.offsets[s + 1]; ++i) total += length(rest.positions, i);
    for (std::size_t i = rest.offsets[s] + 1; i < rest.offsets[s + 1]; ++i) {
      const double own = length(rest.positions, i), now = length(state.positions, i);
      if (own > 1e-7 * total)
        worst = std::max(worst, std::abs(now / own - 1) / std::max(1e-5, 4 * std::pow(2.0, -24) * total / own));
      else if (total > 0)
        worst = std::max(worst, now / (1e-7 * total));
    }
  }
  return worst;
}

inline double fastest(const State& state) {
  double most = 0;
  for (const glm::vec3& velocity : state.velocities) most = std::max(most, double(glm::length(velocity)));
  return most;
}

inline strands::Groom one(const std::vector<double>& segments, const glm::dvec3& direction = {0.6, -0.8, 0}) {
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, direction, segments);
  return groom;
}
/// Segments that run to and fro along `direction`.
inline strands::Groom folded(const glm::dvec3& direction) {
  strands::Groom groom;
  for (int i = 0; i < 32; ++i) groom.positions.emplace_back(i % 2 ? direction * 0.01 : glm::dvec3(0));
  groom.radii.assign(32, strands::k_default_radius);
  groom.offsets = {0, 32};
  return groom;
}
inline std::vector<double> every_fourth_zero() {
  std::vector<double> segments = uniform_segments(31, 0.3);
  for (std::size_t i = 3; i < segments.size(); i += 4) segments[i] = 0;
  return segments;
}
inline std::vector<double> alternating(double ratio) {
  std::vector<double> segments;
  for (int i = 0; i < 31; ++i) segments.push_back(i % 2 ? 0.02 : 0.02 / ratio);
  return segments;
}

inline std::map<std::string, strands::Groom> shapes() {
  return {{"uniform", one(uniform_segments(31, 0.3))},
          {"growing 1:1000", one(growing_segments(31, 0.3, 1000))},
          {"shrinking 1000:1", one(growing_segments(31, 0.3, 1e-3))},
          {"alternating 1:1000", one(alternating(1000))},
          {"every fourth zero", one(every_fourth_zero())},
          {"folded, across", folded({1, 0, 0})},
          {"folded, along gravity", folded({0, -1, 0})},
          {"coincident", one(std::vector<double>(8, 0.0))},
          {"one vertex", one({})},
          {"one link", one({0.05})}};
}

/// How the head moves between frames: it stands, is thrown at 50 m/s to and fro in random directions, or jumps by up to
/// 100 m and back, told as a teleport or not.
enum class Disturbance { none, kicks, jumps, teleports };

/// `on_skin`: the same of a skin that carries all of the hair. Largest of worst_over_bound over the frames that end at
/// the origin. Adds a message where anything is not finite.
inline double run(std::string_view name, const strands::Groom& groom, const std::string& parameters, double duration,
                  Disturbance disturbance, int frames, const EffectBlocks& effects = gravity(), bool on_skin = false) {
  auto solver = make_solver(name, groom, settings(parameters), effects);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const double size = disturbance == Disturbance::kicks ? 50 * std::min(duration, 2.0) : 100;
  double worst = 0;
  glm::dvec3 place(0);
  for (int k = 0; k < frames; ++k) {
    const bool away = disturbance != Disturbance::none && k < frames * 2 / 3 && k % 2 == 0;
    const glm::dvec3 next = away ? glm::dvec3(unit(random), unit(random), unit(random)) * size : glm::dvec3(0);
    FrameInput input{.duration = duration,
                     .head_begin = glm::translate(glm::dmat4(1), place),
                     .head_end = glm::translate(glm::dmat4(1), next),
                     .colliders = {},
                     .teleport = disturbance == Disturbance::teleports};
    std::vector<glm::vec3> skinned;
    if (on_skin)
      for (const glm::vec3& at : groom.positions) skinned.emplace_back(glm::dvec3(at) + next);
    input.skinned = skinned;
    EXPECT_TRUE(solver->advance(input).ok());
    place = next;
    const State state = solver->state().value();
    EXPECT_TRUE(all_finite(state));
    EXPECT_EQ(state.guards_fired, 0u);
    if (next == glm::dvec3(0)) worst = std::max(worst, worst_over_bound(groom, state));
    if (::testing::Test::HasFailure()) break;
  }
  return worst;
}

inline constexpr const char* k_names[] = {"still", "50 m/s kicks", "100 m jumps", "teleports"};

/// Every shape and disturbance at every duration with these settings keeps its lengths; prints a row for each.
inline void expect_lengths(std::string_view name, const std::vector<std::string>& parameters, int frames,
                           bool on_skin = false) {
  for (const auto& [shape, groom] : shapes())
    for (int disturbance = 0; disturbance < 4; ++disturbance) {
      double worst = 0;
      for (double duration : k_durations)
        for (const std::string& set : parameters) {
          worst =
              std::max(worst, run(name, groom, set, duration, Disturbance(disturbance), frames, gravity(), on_skin));
          ASSERT_FALSE(::testing::Test::HasFailure())
              << shape << ", " << k_names[disturbance] << ", step " << duration << ", " << set;
        }
      std::printf("%s%s: %-22s %-13s stretch over its bound, steps of 1e-3 .. 100 s: %.2f\n", name.data(),
                  on_skin ? " on a skin" : "", shape.c_str(), k_names[disturbance], worst);
      EXPECT_LE(worst, 1) << shape << k_names[disturbance];
    }
}

/// The deepest place of any segment past the first link, metres, looked for at 16 places of each; `depth_at`: of a
/// place.
template <class DepthAt>
double deepest_segment(const strands::Groom& groom, const State& state, const DepthAt& depth_at) {
  double most = -1;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t i = groom.offsets[s] + 2; i < groom.offsets[s + 1]; ++i)
      for (int k = 0; k <= 16; ++k)
        most = std::max(
            most, depth_at(glm::mix(glm::dvec3(state.positions[i - 1]), glm::dvec3(state.positions[i]), k / 16.0)));
  return most;
}

// Spheres.

inline double distance_to_segment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length2 = glm::dot(along, along),
               t = length2 > 0 ? glm::clamp(glm::dot(point - a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(point, a + t * along);
}

struct BallCase {
  const char* name;
  glm::dvec3 centre;
  double radius;
  glm::dvec3 direction;
  double resting = 1e-3;  ///< m/s
};
inline const BallCase k_balls[] = {{"rooted on the head", {-0.05, -0.0866, 0}, 0.0999, {0.866, -0.5, 0}},
                                   {"rooted on the head, aslant", {-0.05, -0.0866, 0}, 0.0999, {0.5, 0.33, 0.8}},
                                   {"ball under the root", {0.02, -0.15, 0.01}, 0.1, {1, 0, 0}},
                                   {"smaller ball under the root", {0.05, -0.2, 0}, 0.08, {1, 0, 0}},
                                   {"ball under the root, centred", {0, -0.15, 0}, 0.1, {0, 1, 0}},
                                   {"rope over a small ball", {0.1, -0.02, 0}, 0.02, {1, 0, 0}},
                                   {"ball smaller than a link", {0.1, -0.02, 0}, 0.003, {1, 0, 0}},
                                   {"starts inside", {0.15, 0, 0.01}, 0.05, {1, 0, 0}}};

struct Rest {
  double stretch = 0, depth = 0,
         tip_speed = 0;  ///< over the bound; deepest segment over the radius late; m/s rms of the sixth second
};
inline Rest rest_on(const BallCase& ball, std::string_view name, const std::string& parameters) {
  const strands::Groom groom = one(uniform_segments(31, 0.3), glm::normalize(ball.direction));
  auto solver = make_solver(name, groom, parameters, gravity_and_colliders("pearl_radius=0"));
  const Sphere sphere{ball.centre, ball.radius};
  Rest rest;
  double squares = 0;
  for (int k = 0; k < 360; ++k) {
    const State state = run_still(*solver, 1, 1.0 / 60, {&sphere, 1});
    rest.stretch = std::max(rest.stretch, worst_over_bound(groom, state));
    if (k < 300) continue;
    squares += std::pow(double(glm::length(state.velocities.back())), 2) / 60;
    for (std::size_t i = 2; i < state.positions.size(); ++i)
      rest.depth = std::max(
          rest.depth, 1 - distance_to_segment(ball.centre, state.positions[i - 1], state.positions[i]) / ball.radius);
  }
  rest.tip_speed = std::sqrt(squares);
  return rest;
}

}  // namespace cuticle::sim::testing
