#include "strands/growing/grow.h"

#include <algorithm>
#include <numeric>

#include <fmt/core.h>

#include "core/memory_limit.h"
#include "strands/growing/head_shape.h"
#include "strands/growing/surface.h"
#include "strands/spline/bezier.glslh"
#include "strands/tangent.glslh"

namespace cuticle::strands {

namespace {

Head head_for(const StrandParameters& strands) {
  Head head = make_head(strands.control_hairs);
  if (strands.surface == HairSurface::head) head.scalp = head.mesh;
  return head;
}

/// Density falls to nothing over the outer `share` of a scalp's radius, which its texture coordinates tell.
void thin_at_the_edge(double share, const Mesh& scalp, std::vector<float>& map) {
  if (share <= 0 || scalp.uv.size() != scalp.positions.size()) return;
  if (map.empty()) map.assign(scalp.positions.size(), 1.0f);
  for (std::size_t v = 0; v < map.size(); ++v) {
    const double radius = 2 * glm::length(glm::dvec2(scalp.uv[v]) - 0.5);
    map[v] *= float(std::clamp((1 - radius) / share, 0.0, 1.0));
  }
}

Result<PlacedRoots> roots_for(const GroomingSpecification& specification, const Mesh& scalp) {
  const StrandParameters& strands = specification.strands;
  std::vector<float> map = density_map(specification.grooming, scalp);
  thin_at_the_edge(strands.hairline, scalp, map);
  return place_roots(scalp, {.density = strands.density,
                             .share = strands.share,
                             .density_map = map,
                             .rule = strands.roots,
                             .seed = strands.seed});
}

std::vector<glm::vec3> normals_at(const Mesh& scalp, const std::vector<Root>& roots) {
  std::vector<glm::vec3> normals;
  for (const Root& root : roots) {
    const auto& corners = scalp.triangles[root.triangle];
    const glm::vec3 sum = blend_three<float>(scalp.normals[corners[0]], scalp.normals[corners[1]],
                                             scalp.normals[corners[2]], root.weights);
    normals.push_back(direction_or<float>(sum, glm::vec3(0, 1, 0)));
  }
  return normals;
}

/// Moves all but the roots that `may_be_inside` out of the mesh. Returns how many moved.
template <class Test>
std::size_t move_out(Groom& groom, const Mesh& mesh, double reach, const Test& may_be_inside) {
  constexpr double clearance = 0.0005;
  const NearestSurface surface(mesh, reach);
  std::size_t moved = 0;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t v = groom.offsets[s] + 1; v < groom.offsets[s + 1]; ++v) {
      glm::vec3& point = groom.positions[v];
      if (!may_be_inside(glm::dvec3(point))) continue;
      const SurfaceHit hit = surface.at(glm::dvec3(point));
      if (hit.distance >= 0) continue;
      point += glm::vec3(hit.normal * (clearance - hit.distance));
      ++moved;
    }
  return moved;
}

Groom drawn_between(const Groom& smoothed, const Mesh& scalp, const std::vector<Root>& roots,
                    const StrandParameters& strands) {
  std::vector<std::uint32_t> hairs(scalp.positions.size());
  std::iota(hairs.begin(), hairs.end(), 0u);
  return strands.nearest_hair ? follow(smoothed, scalp, roots, hairs) : interpolate(smoothed, scalp, roots, hairs);
}

/// All but what keeps the strands outside.
Result<Grown> grow_on(const GroomingSpecification& specification, Head head) {
  const StrandParameters& strands = specification.strands;
  Grown grown;
  grown.head = std::move(head);
  CUTICLE_ASSIGN(const PlacedRoots placed, roots_for(specification, grown.head.scalp));
  if (placed.roots.empty())
    return bad_input("strands: area x density x share gives no strand",
                     "raise density or share, or give regions some density");
  // Positions, radii and frames of the strands, and the copies that shaping and smoothing make of them.
  constexpr std::uint64_t bytes_per_vertex = 64;
  const auto vertices = std::uint64_t(strands.vertices);
  CUTICLE_TRY(require_memory(fmt::format("hair of {} strands with {} vertices", placed.roots.size(), vertices),
                             {placed.roots.size(), vertices, bytes_per_vertex}));
  CUTICLE_ASSIGN(grown.control, plant_control_hairs(grown.head, specification.growing, specification.grooming));
  const Groom smoothed = smooth(grown.control, strands.vertices, strands.curve);
  grown.report = {placed.report, deviation_from_controls(grown.control, smoothed), 0};
  grown.drawn = drawn_between(smoothed, grown.head.scalp, placed.roots, strands);
  shape(grown.drawn, specification.shaping, normals_at(grown.head.scalp, placed.roots), strands.seed);
  return grown;
}

}  // namespace

Result<Grown> grow(const GroomingSpecification& specification) {
  constexpr double reach = 0.02;
  CUTICLE_ASSIGN(Grown grown, grow_on(specification, head_for(specification.strands)));
  grown.report.moved_out =
      move_out(grown.drawn, grown.head.mesh, reach, [](const glm::dvec3& point) { return head_distance(point) < 0; });
  return grown;
}

Result<Grown> grow(const GroomingSpecification& specification, Head head) {
  constexpr double reach = 0.05;
  CUTICLE_ASSIGN(Grown grown, grow_on(specification, std::move(head)));
  grown.report.moved_out = move_out(grown.drawn, grown.head.mesh, reach, [](const glm::dvec3&) { return true; });
  return grown;
}

}  // namespace cuticle::strands
