#include <cuticle/strands/growing/growing.h>

#include <algorithm>

#include <glm/geometric.hpp>

#include <cuticle/strands/growing/random.h>

namespace cuticle::strands {

namespace {

/// Running sums of the triangles' areas (twice, in fact: only their ratios count).
std::vector<double> area_sums(const Mesh& mesh) {
  std::vector<double> sums;
  double sum = 0;
  for (const auto& triangle : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[triangle[0]]), b(mesh.positions[triangle[1]]), c(mesh.positions[triangle[2]]);
    sums.push_back(sum += glm::length(glm::cross(b - a, c - a)));
  }
  return sums;
}

/// Two uniforms fill a unit square; its far half is folded onto the triangle, so that weights sum to 1 and stay even.
glm::vec3 folded_weights(double u, double v) {
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return {float(1 - u - v), float(u), float(v)};
}

}  // namespace

std::vector<Root> scatter_roots(const Mesh& scalp, std::size_t count, std::uint64_t seed) {
  CUTICLE_EXPECT(!scalp.triangles.empty(), "a scalp without triangles");
  const std::vector<double> sums = area_sums(scalp);
  std::vector<Root> roots(count);
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream random = random_stream(seed, Chance::root, i);
    const auto found = std::upper_bound(sums.begin(), sums.end() - 1, random.next_unit() * sums.back());
    const double u = random.next_unit();
    roots[i] = {std::uint32_t(found - sums.begin()), folded_weights(u, random.next_unit())};
  }
  return roots;
}

std::vector<Root> identity_roots(std::size_t strand_count) {
  std::vector<Root> roots(strand_count);
  for (std::size_t s = 0; s < strand_count; ++s) roots[s] = {std::uint32_t(s), {1, 0, 0}};
  return roots;
}

}  // namespace cuticle::strands
