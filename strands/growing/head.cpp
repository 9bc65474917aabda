#include "strands/growing/growing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "strands/growing/head_shape.h"
#include "strands/growing/scalp.h"

namespace cuticle::strands {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// A sphere of triangles: an icosahedron whose edges are halved `levels` times; unit directions.
struct DirectionMesh {
  std::vector<glm::dvec3> directions;
  Triangles triangles;
};

DirectionMesh icosahedron() {
  const double g = std::numbers::phi;
  DirectionMesh mesh;
  mesh.directions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                     {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (glm::dvec3& direction : mesh.directions) direction = glm::normalize(direction);
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

DirectionMesh halved(const DirectionMesh& coarse) {
  DirectionMesh fine{coarse.directions, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), std::uint32_t(fine.directions.size()));
    if (is_new) fine.directions.push_back(glm::normalize(fine.directions[a] + fine.directions[b]));
    return found->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return fine;
}

Mesh make_head_mesh() {
  constexpr int levels = 5;
  DirectionMesh sphere = icosahedron();
  for (int level = 0; level < levels; ++level) sphere = halved(sphere);
  const glm::dvec3 center(k_head_center[0], k_head_center[1], k_head_center[2]);
  Mesh mesh;
  mesh.triangles = std::move(sphere.triangles);
  mesh.positions.resize(sphere.directions.size());
  tbb::parallel_for(std::size_t(0), mesh.positions.size(),
                    [&](std::size_t v) { mesh.positions[v] = head_surface_point(center, sphere.directions[v]); });
  compute_normals(mesh);
  return mesh;
}

}  // namespace

Head make_head(int scalp_vertices) {
  CUTICLE_EXPECT(scalp_vertices >= 8 && scalp_vertices <= 100000, "scalp vertices outside 8 .. 100000");
  Head head;
  static const Mesh mesh = make_head_mesh();  // always the same, and not cheap
  head.mesh = mesh;
  head.scalp = make_scalp(scalp_vertices, [](const glm::dvec3& direction) {
    const glm::dvec3 point = head_surface_point(k_skull_center, direction);
    return SkinPoint{point, head_normal(point)};
  });
  head.colliders = {{{0, 0.150, 0.008}, 0.069},    // front of the skull
                    {{0, 0.148, -0.032}, 0.070},   // back of the skull
                    {{0, 0.092, 0.030}, 0.050},    // face
                    {{0, 0.045, 0.030}, 0.040},    // jaw
                    {{0, 0.000, -0.028}, 0.046}};  // neck
  return head;
}

}  // namespace cuticle::strands
