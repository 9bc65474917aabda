#include "sim/cloth/cloth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <fmt/core.h>
#include <glm/gtc/quaternion.hpp>

#include "sim/classic/particles.h"
#include "sim/colliders/contact.glslh"
#include "sim/control/control.h"

namespace cuticle::sim {
namespace {

struct Edge {
  std::uint32_t a = 0, b = 0;
  float length = 0;
};

/// Every edge of the mesh once that has a simulated end, from the rigid root outwards.
std::vector<Edge> edges_of(const strands::Mesh& mesh, std::span<const float> weights) {
  std::vector<Edge> edges;
  for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      if (weights[a] > 0 || weights[b] > 0)
        edges.push_back({a, b, glm::distance(mesh.positions[a], mesh.positions[b])});
    }
  const auto key = [&](const Edge& e) { return std::tuple(weights[e.a] + weights[e.b], e.a, e.b); };
  std::ranges::sort(edges, {}, key);
  const auto same = [&](const Edge& one, const Edge& other) { return key(one) == key(other); };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  return edges;
}

/// The mesh as one list of vertices with the skin's weight, as manual control takes it.
strands::Groom sheet_of(const strands::Mesh& mesh, std::span<const float> weights) {
  strands::Groom sheet;
  sheet.positions = mesh.positions;
  sheet.offsets.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
  strands::Attribute& control = sheet.attributes["control"];
  for (float weight : weights) control.values.push_back(1 - weight);
  return sheet;
}

constexpr control::Control k_whole_control{.root = 1, .tip = 1, .begin = 0, .end = 1e9, .fade = 0};

class Sheet final : public Solver {
 public:
  Sheet(const strands::Mesh& mesh, std::span<const float> weights, const classic::Settings& settings)
      : settings_(settings),
        edges_(edges_of(mesh, weights)),
        positions_(mesh.positions),
        starts_(mesh.positions),
        velocities_(mesh.positions.size(), glm::vec3(0)) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
      places_.emplace_back(mesh.positions[i], 0);
      traits_.emplace_back(0, weights[i], 0, 0);
    }
    set_masses(weights);
    last_places_ = places_;
  }

  Result<void> advance(const FrameInput& input) override {
    CUTICLE_ASSIGN(const std::vector<Substep> parts, motion_.advance(input, substeps(settings_, input.duration)));
    translation_ = parts.back().translation;
    const std::vector<glm::vec4> next = skinned_places(input);
    colliders::SubstepSpheres spheres;
    if (settings_.contact) spheres = colliders::packed(input, parts.size());
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const float share = float(k + 1) / float(parts.size());
      begin_places_ = places_;
      for (std::size_t i = 0; i < places_.size(); ++i)
        places_[i] = last_places_[i] + (next[i] - last_places_[i]) * share;
      run(classic::make_step(settings_, parts[k], 1), spheres.at_end(k));
    }
    last_places_ = next;
    return {};
  }

  Result<State> state() override {
    State state{.positions = positions_, .velocities = velocities_, .guards_fired = guard_fired_ ? 1u : 0u};
    for (glm::vec3& position : state.positions) position += translation_;
    return state;
  }

 private:
  /// Half the length of its edges over the mean; 0 where the skin holds the vertex.
  void set_masses(std::span<const float> weights) {
    double total = 0;
    std::vector<double> lengths(weights.size(), 0);
    for (const Edge& edge : edges_) {
      total += 2 * double(edge.length);
      for (std::uint32_t end : {edge.a, edge.b}) {
        lengths[end] += double(edge.length);
        traits_[end].w = std::max(traits_[end].w, edge.length);
      }
    }
    const double mean = total / double(std::max<std::size_t>(1, weights.size()));
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (weights[i] > 0) traits_[i].x = mean > 0 ? float(1 / std::max(1e-3, lengths[i] / mean)) : 1.f;
  }

  /// Where the skin wants the vertices at the frame's end, in the head's rest space.
  std::vector<glm::vec4> skinned_places(const FrameInput& input) const {
    if (input.authored.empty()) return last_places_;
    const glm::dmat4 to_rest = glm::inverse(input.head_end);
    std::vector<glm::vec4> places;
    for (const glm::vec3& place : input.authored)
      places.emplace_back(glm::vec3(to_rest * glm::dvec4(glm::dvec3(place), 1)), 0);
    return places;
  }

  void run(const classic::StepConstants& step, std::span<const glm::vec4> spheres) {
    const classic::Particles particles{places_, traits_, positions_, starts_, velocities_, begin_places_};
    integrate(particles, step);
    for (std::uint32_t sweep = 0; sweep < settings_.iterations; ++sweep) {
      for (const Edge& edge : edges_) keep_distance(particles, edge.a, edge.b, edge.length, step.rotation_end);
      if (settings_.contact) push_out(step, spheres);
    }
    guard_fired_ = finish(particles, step);
  }

  void push_out(const classic::StepConstants& step, std::span<const glm::vec4> spheres) {
    for (const glm::vec4& sphere : spheres) {
      const glm::vec3 centre = turned(glm::vec3(sphere), glm::vec3(step.rotation_end), step.rotation_end.w);
      for (std::size_t i = 0; i < positions_.size(); ++i) {
        if (traits_[i].x == 0) continue;
        const float pearl = pearl_of(sphere.w, traits_[i].w, settings_.contact->pearl_radius,
                                     settings_.contact->fit_pearls ? 1.f : 0.f);
        positions_[i] = pushed_out(positions_[i], centre, sphere.w + pearl, glm::vec3(0, 1, 0));
      }
    }
  }

  classic::Settings settings_;
  std::vector<Edge> edges_;
  std::vector<glm::vec4> places_, begin_places_, last_places_, traits_;
  std::vector<glm::vec3> positions_, starts_, velocities_;
  HeadMotion motion_;
  glm::vec3 translation_{0};
  bool guard_fired_ = false;
};

Result<void> check(const strands::Mesh& mesh, std::span<const float> weights) {
  if (weights.size() != mesh.positions.size())
    return bad_input(fmt::format("weights: {} for {} vertices", weights.size(), mesh.positions.size()));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] >= 0 && weights[i] <= 1))
      return bad_input(fmt::format("weights[{}]: {} is outside 0 .. 1", i, weights[i]));
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(mesh.positions[i][c]))
        return bad_input(fmt::format("positions[{}]: component {} is not finite", i, c));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t corner : mesh.triangles[t])
      if (corner >= weights.size())
        return bad_input(fmt::format("triangles[{}]: vertex {} of {}", t, corner, weights.size()));
  return {};
}

}  // namespace

Result<std::unique_ptr<Solver>> make_cloth(const strands::Mesh& mesh, std::span<const float> weights,
                                           const cloth::Cloth& cloth, const EffectBlocks& effects) {
  CUTICLE_TRY(classic::check_effects(effects));
  CUTICLE_TRY(check(mesh, weights));
  return control::controlled(std::make_unique<Sheet>(mesh, weights, classic::make_settings(cloth, effects)),
                             sheet_of(mesh, weights), k_whole_control);
}

}  // namespace cuticle::sim
