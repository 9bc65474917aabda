#include "sim/rest_pose.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace cuticle::sim {
namespace {

constexpr double k_smallest_mass = 1e-3;

std::vector<double> segment_lengths(std::span<const glm::vec3> strand) {
  std::vector<double> lengths(strand.size() + 1, 0.0);
  for (std::size_t i = 1; i < strand.size(); ++i)
    lengths[i] = glm::distance(glm::dvec3(strand[i - 1]), glm::dvec3(strand[i]));
  return lengths;
}

float inverse_mass(const std::vector<double>& lengths, std::size_t vertex, double mean) {
  if (mean <= 0) return 1;
  return static_cast<float>(1 / std::max(k_smallest_mass, (lengths[vertex] + lengths[vertex + 1]) / (2 * mean)));
}

void append_strand(RestPose& pose, std::span<const glm::vec3> strand, std::uint32_t clamped) {
  const std::vector<double> lengths = segment_lengths(strand);
  double total = 0, arc = 0, reach = 0;
  for (double length : lengths) total += length;
  const double mean = strand.size() > 1 ? total / double(strand.size() - 1) : 0;
  for (std::size_t i = 0; i < strand.size(); ++i) {
    arc += lengths[i];
    if (i >= clamped) reach += lengths[i];
    pose.places.emplace_back(strand[i], static_cast<float>(lengths[i]));
    pose.traits.emplace_back(i < clamped ? 0.f : inverse_mass(lengths, i, mean),
                             static_cast<float>(total > 0 ? std::min(1.0, arc / total) : 0.0),
                             static_cast<float>(reach), static_cast<float>(std::max(lengths[i], lengths[i + 1])));
  }
}

}  // namespace

RestPose make_rest_pose(const strands::Groom& groom, std::uint32_t clamped_vertices) {
  RestPose pose;
  pose.offsets = groom.offsets;
  pose.places.reserve(groom.vertex_count());
  pose.traits.reserve(groom.vertex_count());
  for (std::size_t s = 0; s < groom.strand_count(); ++s) append_strand(pose, groom.strand(s), clamped_vertices);
  return pose;
}

}  // namespace cuticle::sim
