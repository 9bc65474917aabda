#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

#include "strands/cards/card_mesh.h"
#include "strands/cards/disjoint_sets.h"

namespace cuticle::strands {

namespace {

/// From the half-line down from the center.
float distance_outside(const glm::vec3& point, const glm::vec3& center) {
  const glm::vec3 apart = point - center;
  return glm::length(apart.y > 0 ? apart : glm::vec3(apart.x, 0, apart.z));
}

/// Per set the mean distance of its triangles' middles by their area.
std::vector<float> mean_distances(const Mesh& mesh, DisjointSets& sets, const glm::vec3& center) {
  std::vector<double> sums(mesh.positions.size()), areas(mesh.positions.size());
  for (const auto& corners : mesh.triangles) {
    const auto [a, b, c] =
        std::array{mesh.positions[corners[0]], mesh.positions[corners[1]], mesh.positions[corners[2]]};
    const std::uint32_t set = sets.find(corners[0]);
    const double area = double(glm::length(glm::cross(b - a, c - a))) + 1e-30;
    sums[set] += area * double(distance_outside((a + b + c) / 3.0f, center));
    areas[set] += area;
  }
  std::vector<float> means;
  for (std::size_t set = 0; set < sums.size(); ++set) means.push_back(float(sums[set] / std::max(areas[set], 1e-30)));
  return means;
}

}  // namespace

std::vector<MeshComponent> sort_inside_to_outside(Mesh& mesh, const glm::vec3& center) {
  DisjointSets sets(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) sets.join(a, b), sets.join(a, c);
  const std::vector<float> distances = mean_distances(mesh, sets, center);
  // Sets in the order in which the triangles name them, so that equal distances keep it.
  constexpr std::uint32_t k_none = 0xFFFFFFFF;
  std::vector<std::uint32_t> met(mesh.positions.size(), k_none), order(mesh.triangles.size());
  std::uint32_t count = 0;
  std::iota(order.begin(), order.end(), 0u);
  const auto set_of = [&](std::uint32_t t) { return sets.find(mesh.triangles[t][0]); };
  for (std::uint32_t t : order)
    if (met[set_of(t)] == k_none) met[set_of(t)] = count++;
  std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return std::pair(distances[set_of(t)], met[set_of(t)]); });
  std::vector<MeshComponent> components;
  for (std::size_t place = 0; place < order.size(); ++place) {
    const std::uint32_t set = set_of(order[place]);
    if (place == 0 || set != set_of(order[place - 1]))
      components.push_back({.first_triangle = std::uint32_t(place), .outside = distances[set]});
    ++components.back().triangle_count;
  }
  std::vector<std::array<std::uint32_t, 3>> sorted;
  for (std::uint32_t t : order) sorted.push_back(mesh.triangles[t]);
  mesh.triangles = std::move(sorted);
  return components;
}

}  // namespace cuticle::strands
