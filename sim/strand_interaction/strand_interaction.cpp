#include "sim/strand_interaction/strand_interaction.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace cuticle::sim::strand_interaction {
namespace {

Found<float> found_of(const GridSums& sums, const Spot& spot) {
  const glm::vec3 share = glm::vec3(spot.fine[0], spot.fine[1], spot.fine[2]) * (1.f / 32);
  Found<float> found{glm::vec3(0), 0, glm::vec3(0)};
#pragma GCC unroll 8
  for (std::uint32_t k = 0; k < 8; ++k) {
    const NodeMean& node = sums.at(spot, k);
    found = found_at(found, k, share, node.velocity, node.mass);
  }
  return found;
}

glm::vec3 counted(const glm::vec3& velocity) {
  return {counted_speed(velocity.x), counted_speed(velocity.y), counted_speed(velocity.z)};
}

void turn_to(const glm::dmat3& rotation, GridFrame<float>& frame) {
  frame.turn_x = glm::vec3(rotation[0]);
  frame.turn_y = glm::vec3(rotation[1]);
  frame.turn_z = glm::vec3(rotation[2]);
}

}  // namespace

std::vector<float> rest_densities(const StrandGrid& grid, const strands::Groom& rest, double onset) {
  GridSums sums(grid);
  const std::vector<glm::vec3> still(rest.vertex_count(), glm::vec3(0));
  sums.deposit(rest.positions, still);
  std::vector<float> densities(rest.vertex_count(), 0.f);
  double total = 0, mass = 0;
  for (std::size_t i = 0; i < densities.size(); ++i) {
    if (sums.spot(i).node == Spot::k_nowhere) continue;
    densities[i] = found_of(sums, sums.spot(i)).density;
    total += double(densities[i]) * grid.masses[i];
    mass += grid.masses[i];
  }
  const float mean = mass > 0 ? float(total / mass) : 1.f;
  for (float& density : densities) density = std::max(density, mean) * float(onset);
  return densities;
}

GridFrame<float> frame_constants(const StrandGrid& grid, const Settings& settings, const glm::dmat3& rotation,
                                 const glm::dvec3& translation, double duration) {
  GridFrame<float> frame;
  turn_to(rotation, frame);
  frame.per_fine = float(32 / grid.cell);
  frame.smoothing = float(-std::expm1(-settings.smoothing * duration));
  frame.duration = float(duration);
  frame.origin = grid.origin;
  frame.pressure = float(settings.pressure * settings.pressure);
  frame.translation = glm::vec3(translation);
  frame.most = float(settings.most_acceleration);
  return frame;
}

StrandInteraction::StrandInteraction(const StrandGrid& grid, const strands::Groom& rest, const Settings& settings)
    : grid_(grid),
      settings_(settings),
      offsets_(rest.offsets),
      rest_densities_(rest_densities(grid, rest, settings.onset)),
      sums_(grid),
      places_(rest.positions),
      velocities_(rest.vertex_count(), glm::vec3(0)),
      changes_(rest.vertex_count(), glm::vec3(0)) {}

Result<std::unique_ptr<StrandInteraction>> StrandInteraction::create(const strands::Groom& rest,
                                                                     const Settings& settings) {
  CUTICLE_ASSIGN(const StrandGrid grid, make_strand_grid(rest, settings.cell));
  return std::unique_ptr<StrandInteraction>(new StrandInteraction(grid, rest, settings));
}

std::span<const glm::vec3> StrandInteraction::changes(std::span<const glm::dmat3> rotations, double duration) {
  sums_.deposit(places_, velocities_);
  const GridFrame<float> of_first = frame_constants(grid_, settings_, rotations[0], glm::dvec3(0), duration);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, offsets_.size() - 1, 64), [&](const auto& strands) {
    GridFrame<float> frame = of_first;
    for (std::size_t s = strands.begin(); s < strands.end(); ++s) {
      if (rotations.size() > 1) turn_to(rotations[s], frame);
      for (std::size_t i = offsets_[s]; i < offsets_[s + 1]; ++i) {
        const Spot& spot = sums_.spot(i);
        changes_[i] = spot.node == Spot::k_nowhere
                          ? glm::vec3(0)
                          : velocity_change(frame, found_of(sums_, spot), counted(velocities_[i]), rest_densities_[i]);
      }
    }
  });
  return changes_;
}

}  // namespace cuticle::sim::strand_interaction
