#include "plan/fitted_head.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace cuticle::plan {

namespace {

double off_sphere(const glm::vec3& point, const Sphere& sphere) {
  return std::abs(glm::distance(glm::dvec3(point), sphere.center) - sphere.radius);
}

double off_sphere(std::span<const glm::vec3> points, const Sphere& sphere) {
  double sum = 0;
  for (const glm::vec3& point : points) sum += std::pow(off_sphere(point, sphere), 2) / double(points.size());
  return std::sqrt(sum);
}

/// Of most of the roots: a ponytail's may lie far from the skull.
Result<Sphere> scalp_sphere(std::span<const glm::vec3> roots) {
  constexpr double k_least = 0.02, k_most = 1, k_off = 0.25, k_kept = 2;
  constexpr int k_rounds = 4;
  CUTICLE_ASSIGN(Sphere sphere, fit_sphere(roots));
  std::vector<glm::vec3> near(roots.begin(), roots.end());
  for (int round = 0; round < k_rounds; ++round) {
    const double limit = k_kept * off_sphere(near, sphere);
    std::erase_if(near, [&](const glm::vec3& root) { return off_sphere(root, sphere) > limit; });
    if (const Result<Sphere> nearer = fit_sphere(near)) sphere = *nearer;
  }
  const double off = off_sphere(near, sphere);
  if (sphere.radius >= k_least && sphere.radius <= k_most && off <= k_off * sphere.radius) return sphere;
  return bad_input(
      fmt::format("head.fit: the roots lie about a sphere of radius {:.3g} m, {:.2g} m off it; allowed: {} "
                  ".. {} m, a quarter of that",
                  sphere.radius, off, k_least, k_most));
}

/// The turn about the vertical, in quarters, by which a face at +z looks away from where most roots are: hair grows on
/// the back of a head, and not on its face.
glm::dmat3 facing(std::span<const glm::vec3> roots, const Sphere& sphere) {
  glm::dvec3 mean{0};
  for (const glm::vec3& root : roots) mean += (glm::dvec3(root) - sphere.center) / double(roots.size());
  const double quarter = std::round(std::atan2(-mean.x, -mean.z) / (std::numbers::pi / 2));
  const double angle = std::hypot(mean.x, mean.z) > 0 ? quarter * std::numbers::pi / 2 : 0;
  return {{std::cos(angle), 0, -std::sin(angle)}, {0, 1, 0}, {std::sin(angle), 0, std::cos(angle)}};
}

}  // namespace

Result<Sphere> fit_sphere(std::span<const glm::vec3> points) {
  // |p|^2 = 2 c.p + (r^2 - |c|^2): linear in c and the last term. Solved about the mean, for accuracy.
  glm::dvec3 mean{0};
  for (const glm::vec3& point : points) mean += glm::dvec3(point) / double(points.size());
  glm::dmat4 matrix{0};
  glm::dvec4 right{0};
  for (const glm::vec3& point : points) {
    const glm::dvec3 p = glm::dvec3(point) - mean;
    const glm::dvec4 row(2.0 * p, 1);
    matrix += glm::outerProduct(row, row);
    right += row * glm::dot(p, p);
  }
  const glm::dvec4 solution = glm::inverse(matrix) * right;
  const double squared = solution.w + glm::dot(glm::dvec3(solution), glm::dvec3(solution));
  if (points.size() < 4 || !std::isfinite(squared) || !(squared > 0))
    return bad_input("colliders.head: no sphere can be fitted to the roots", "give colliders.spheres");
  return Sphere{glm::dvec3(solution) + mean, std::sqrt(squared)};
}

Result<strands::Head> fitted_head(strands::Head head, std::span<const glm::vec3> roots) {
  constexpr double k_below_roots = 0.98;
  CUTICLE_ASSIGN(const Sphere wanted, scalp_sphere(roots));
  CUTICLE_ASSIGN(const Sphere own, fit_sphere(head.scalp.positions));
  const double scale = k_below_roots * wanted.radius / own.radius;
  const glm::dmat3 turn = facing(roots, wanted);
  const auto placed = [&](const glm::dvec3& point) { return wanted.center + turn * (scale * (point - own.center)); };
  for (strands::Mesh* mesh : {&head.mesh, &head.scalp})
    for (std::size_t v = 0; v < mesh->positions.size(); ++v) {
      mesh->positions[v] = placed(mesh->positions[v]);
      mesh->normals[v] = turn * glm::dvec3(mesh->normals[v]);
    }
  for (Sphere& sphere : head.colliders) sphere = {placed(sphere.center), scale * sphere.radius};
  return head;
}

}  // namespace cuticle::plan
