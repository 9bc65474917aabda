#include "strands/growing/mesh_head.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include "strands/growing/scalp.h"
#include "strands/spline/bezier.glslh"

namespace cuticle::strands {

namespace {

/// p -> scale p + shift.
struct Placement {
  double scale = 1;
  glm::dvec3 shift{0};
};

void place(const Placement& placement, Mesh& mesh) {
  for (glm::vec3& point : mesh.positions) point = glm::vec3(placement.scale * glm::dvec3(point) + placement.shift);
}

std::size_t nearest_vertex(const Mesh& mesh, const glm::vec3& point) {
  std::size_t best = 0;
  float least = INFINITY;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::vec3 offset = mesh.positions[v] - point;
    if (const float squared = glm::dot(offset, offset); squared < least) least = squared, best = v;
  }
  return best;
}

/// The mesh's crown under the scalp's: equal heights of the top and middles of what lies within 5 cm below it.
Placement crown_on_crown(const Mesh& mesh, const Mesh& scalp) {
  const auto crown = [](const Mesh& of) {
    constexpr float k_below = 0.05f;
    float top = -INFINITY;
    for (const glm::vec3& point : of.positions) top = std::max(top, point.y);
    glm::vec3 lower(INFINITY), upper(-INFINITY);
    for (const glm::vec3& point : of.positions)
      if (point.y > top - k_below) lower = glm::min(lower, point), upper = glm::max(upper, point);
    return glm::dvec3(0.5f * (lower.x + upper.x), top, 0.5f * (lower.z + upper.z));
  };
  return {1, crown(scalp) - crown(mesh)};
}

/// One step of iterated closest points: the scale and shift that bring the tangent planes of the mesh's nearest
/// vertices to the scalp's points, in least squares. `off`: the rms of the distances before it.
Placement toward(const Mesh& mesh, const Mesh& scalp, double& off) {
  glm::dmat4 matrix(0);
  glm::dvec4 right(0);
  off = 0;
  for (const glm::vec3& point : scalp.positions) {
    const std::size_t v = nearest_vertex(mesh, point);
    const glm::dvec3 normal(mesh.normals[v]), there(mesh.positions[v]);
    const glm::dvec4 row(normal, glm::dot(normal, there));
    const double target = glm::dot(normal, glm::dvec3(point));
    matrix += glm::outerProduct(row, row);
    right += row * target;
    off += std::pow(target - row.w, 2) / double(scalp.positions.size());
  }
  off = std::sqrt(off);
  const glm::dvec4 solution = glm::inverse(matrix) * right;
  return {solution.w, glm::dvec3(solution)};
}

Result<void> fit_skull(const Mesh& scalp, Mesh& mesh) {
  constexpr int k_rounds = 40;
  constexpr double k_least = 0.5, k_most = 2, k_off = 0.01;
  place(crown_on_crown(mesh, scalp), mesh);
  double scale = 1, off = 0;
  for (int round = 0; round < k_rounds; ++round) {
    const Placement next = toward(mesh, scalp, off);
    scale *= next.scale;
    if (!(scale >= k_least && scale <= k_most)) break;
    place(next, mesh);
  }
  if (scale >= k_least && scale <= k_most && off <= k_off) return {};
  return bad_input(fmt::format("head.mesh: its skull lies {:.2g} m off the procedural head's at {:.2g} times its size; "
                               "allowed: {} m, {} .. {}",
                               off, scale, k_off, k_least, k_most),
                   "give a head with y up that faces +z, and head.metres_per_unit");
}

/// Where a ray meets a triangle: its parameter and the barycentric weights.
struct Crossing {
  double along;
  glm::vec3 weights;
};

std::optional<Crossing> crossing(const glm::dvec3& from, const glm::dvec3& direction, const glm::dvec3& a,
                                 const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, across = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, across);
  if (determinant == 0) return std::nullopt;
  const glm::dvec3 to = from - a, turned = glm::cross(to, ab);
  const double u = glm::dot(to, across) / determinant, v = glm::dot(direction, turned) / determinant;
  const double along = glm::dot(ac, turned) / determinant;
  if (u < 0 || v < 0 || u + v > 1 || along <= 0) return std::nullopt;
  return Crossing{along, glm::vec3(1 - u - v, u, v)};
}

/// The first crossing: the skull's own skin, where an ear or a fold lies behind it.
std::optional<SkinPoint> skin_along(const Mesh& mesh, const glm::dvec3& direction) {
  double nearest = INFINITY;
  std::optional<SkinPoint> found;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = crossing(k_skull_center, direction, glm::dvec3(mesh.positions[a]), glm::dvec3(mesh.positions[b]),
                             glm::dvec3(mesh.positions[c]));
    if (!at || at->along >= nearest) continue;
    nearest = at->along;
    const glm::vec3 normal = blend_three<float>(mesh.normals[a], mesh.normals[b], mesh.normals[c], at->weights);
    found = SkinPoint{k_skull_center + direction * nearest, glm::dvec3(unit_or_up(glm::dvec3(normal)))};
  }
  return found;
}

std::vector<Sphere> inside(const Mesh& mesh, std::vector<Sphere> spheres) {
  for (Sphere& sphere : spheres) {
    const glm::vec3 center(sphere.center);
    sphere.radius = double(glm::distance(mesh.positions[nearest_vertex(mesh, center)], center));
  }
  return spheres;
}

}  // namespace

Result<Head> head_of_mesh(Mesh mesh, int scalp_vertices) {
  if (mesh.positions.empty() || mesh.normals.size() != mesh.positions.size())
    return bad_input("head.mesh: hair grows along normals, and the mesh has none");
  Head head = make_head(scalp_vertices);
  CUTICLE_TRY(fit_skull(head.scalp, mesh));
  bool is_closed = true;
  head.scalp = make_scalp(scalp_vertices, [&](const glm::dvec3& direction) {
    const auto at = skin_along(mesh, direction);
    is_closed = is_closed && at;
    return at.value_or(SkinPoint{k_skull_center, {0, 1, 0}});
  });
  if (!is_closed) return bad_input("head.mesh: the skull has holes where hair is to grow", "close the mesh there");
  head.colliders = inside(mesh, std::move(head.colliders));
  head.mesh = std::move(mesh);
  return head;
}

}  // namespace cuticle::strands
