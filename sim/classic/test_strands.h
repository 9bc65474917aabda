#pragma once
// Strands and runs that the tests of the solver share.
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "sim/solver.h"

namespace cuticle::sim::testing {

/// A straight strand from `root` along `direction` (unit) with these segment lengths, metres.
inline void add_straight(strands::Groom& groom, glm::dvec3 root, const glm::dvec3& direction,
                         const std::vector<double>& segments) {
  groom.positions.emplace_back(root);
  for (double segment : segments) groom.positions.emplace_back(root += direction * segment);
  groom.radii.resize(groom.positions.size(), strands::k_default_radius);
  groom.offsets.push_back(static_cast<std::uint32_t>(groom.positions.size()));
}
inline std::vector<double> uniform_segments(int count, double total) {
  return std::vector<double>(count, total / count);
}
/// Segments that grow geometrically from root to tip; the last is `ratio` times the first.
inline std::vector<double> growing_segments(int count, double total, double ratio) {
  std::vector<double> segments(count);
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += segments[i] = std::pow(ratio, double(i) / std::max(1, count - 1));
  for (double& segment : segments) segment *= total / sum;
  return segments;
}
/// `count` strands of 0.3 m, 16 segments growing 1:4, on a ring, pointing outwards and up.
inline strands::Groom ring(int count) {
  strands::Groom groom;
  for (int s = 0; s < count; ++s) {
    const double angle = 2 * 3.14159265358979 * s / count;
    const glm::dvec3 outward(std::cos(angle), 0, std::sin(angle));
    add_straight(groom, 0.1 * outward, glm::normalize(outward + glm::dvec3(0, 0.5, 0)), growing_segments(16, 0.3, 4));
  }
  return groom;
}

/// The groom as a skin carries it that deforms: every strand turns about its own root, up to a radian to and fro, and
/// goes up and down.
inline std::vector<glm::vec3> on_turning_roots(const strands::Groom& groom, double time) {
  std::vector<glm::vec3> places;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const glm::dvec3 root(groom.strand(s)[0]), lift(0, 0.05 * std::sin(7 * time + double(s)), 0);
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), std::sin(5 * time + double(s)), glm::dvec3(0, 0.6, 0.8));
    for (const glm::vec3& place : groom.strand(s))
      places.emplace_back(root + lift + glm::dvec3(turn * glm::dvec4(glm::dvec3(place) - root, 0)));
  }
  return places;
}

/// A strand whose squares overflow, and after its 17 vertices `good`.
inline strands::Groom beside_overflow(const strands::Groom& good) {
  strands::Groom mixed;
  add_straight(mixed, {0, 0, 0}, {1, 0, 0}, std::vector<double>(16, 1e25));
  for (std::size_t s = 0; s < good.strand_count(); ++s) {
    mixed.positions.insert(mixed.positions.end(), good.strand(s).begin(), good.strand(s).end());
    mixed.offsets.push_back(static_cast<std::uint32_t>(mixed.positions.size()));
  }
  mixed.radii.assign(mixed.vertex_count(), strands::k_default_radius);
  return mixed;
}

/// Curls, so that a turn about their own axis shows.
inline strands::Groom curls() {
  strands::Groom groom;
  for (int s = 0; s < 3; ++s) {
    for (int i = 0; i <= 16; ++i)
      groom.positions.emplace_back(0.1 * s + 0.01 * std::cos(0.7 * i), 0.012 * i, 0.01 * std::sin(0.7 * i));
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), strands::k_default_radius);
  return groom;
}

inline registry::ParameterValues settings_of(std::string_view name, const std::string& assignments = {}) {
  return registry::parse_assignments((*find_effect(name))->entry.parameters, assignments).value();
}
/// Free hair: no damping, no pull to the rest pose.
inline const std::string k_free = "damping=0,shape_stiffness=0,clamped_vertices=1";
inline EffectBlocks gravity() { return {{"gravity", settings_of("gravity")}}; }
inline EffectBlocks gravity_and_colliders(const std::string& colliders = {}) {
  return {{"gravity", settings_of("gravity")}, {"colliders", settings_of("colliders", colliders)}};
}
inline std::unique_ptr<Solver> make_solver(std::string_view name, const strands::Groom& groom,
                                           const std::string& settings, const EffectBlocks& effects) {
  return (*find_effect(name))->create(groom, settings_of(name, settings), effects).value();
}
inline std::unique_ptr<Solver> make_classic(const strands::Groom& groom, const std::string& settings,
                                            const EffectBlocks& effects) {
  return make_solver("classic", groom, settings, effects);
}
inline std::unique_ptr<Solver> make_exact(const strands::Groom& groom, const std::string& settings,
                                          const EffectBlocks& effects) {
  return make_solver("exact", groom, settings, effects);
}

/// A head that turns to and fro about the vertical, 60 degrees each way, while it walks away from the origin.
inline glm::dmat4 head_at(double time, glm::dvec3 origin = {}) {
  const glm::dmat4 walk = glm::translate(glm::dmat4(1), origin + glm::dvec3(0.5 * time, 0.1 * std::sin(3 * time), 0));
  return glm::rotate(walk, 1.05 * std::sin(4 * time), glm::dvec3(0, 1, 0));
}
inline FrameInput frame_of(int frame, double duration = 1.0 / 30, glm::dvec3 origin = {}) {
  FrameInput input;
  input.duration = duration;
  input.head_begin = head_at(frame * duration, origin);
  input.head_end = head_at((frame + 1) * duration, origin);
  return input;
}
/// Runs `frames` frames of the moving head; gives the last state.
inline State run_frames(Solver& solver, int frames, std::span<const Sphere> colliders = {}, glm::dvec3 origin = {}) {
  for (int k = 0; k < frames; ++k) {
    FrameInput input = frame_of(k, 1.0 / 30, origin);
    input.colliders = colliders;
    EXPECT_TRUE(solver.advance(input).ok());
  }
  return solver.state().value();
}
/// Runs frames of a head at rest at the origin.
inline State run_still(Solver& solver, int frames, double duration, std::span<const Sphere> colliders = {}) {
  FrameInput input;
  input.duration = duration;
  input.colliders = colliders;
  for (int k = 0; k < frames; ++k) EXPECT_TRUE(solver.advance(input).ok());
  return solver.state().value();
}

inline bool all_finite(const State& state) {
  for (const std::vector<glm::vec3>* list : {&state.positions, &state.velocities})
    for (const glm::vec3& v : *list)
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
  return true;
}
inline double worst_distance(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, double(glm::distance(a[i], b[i])));
  return worst;
}
/// Largest |length / rest length - 1| of any segment.
inline double worst_stretch(const strands::Groom& rest, const State& state) {
  double worst = 0;
  for (float ratio : stretch(rest, state.positions)) worst = std::max(worst, std::abs(double(ratio) - 1));
  return worst;
}

inline void advance_on(Solver& solver, std::span<const glm::vec3> skinned, double duration = 1.0 / 30) {
  EXPECT_TRUE(solver.advance({.duration = duration, .skinned = skinned}).ok());
}

/// After frames in motion the skin of `groom` is elsewhere and told as a teleport: how far hair is from it, m and m/s.
struct OffSkin {
  double places, speeds;
};
inline OffSkin after_teleport_of_skin(Solver& solver, const strands::Groom& groom) {
  for (int frame = 0; frame < 10; ++frame) advance_on(solver, on_turning_roots(groom, frame / 30.0));
  std::vector<glm::vec3> skinned = on_turning_roots(groom, 3);
  for (glm::vec3& place : skinned) place += glm::vec3(5, 0, 0);
  EXPECT_TRUE(solver.advance({.duration = 1.0 / 30, .teleport = true, .skinned = skinned}).ok());
  const State state = solver.state().value();
  return {worst_distance(state.positions, skinned),
          worst_distance(state.velocities, std::vector<glm::vec3>(skinned.size()))};
}

}  // namespace cuticle::sim::testing
