#include "plan/drawn_strands.h"

#include <numeric>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "strands/spline/smooth.h"

namespace cuticle::plan {
namespace {

/// Follow hairs keep their offsets in the head's frame.
strands::Groom placed_at(const StrandSet& set, strands::Groom control, const glm::dmat3& turn) {
  const glm::dmat3 back = glm::transpose(turn);
  for (glm::vec3& position : control.positions) position = glm::vec3(back * glm::dvec3(position));
  strands::Groom placed = strands::place(control, set.placed);
  for (glm::vec3& position : placed.positions) position = glm::vec3(turn * glm::dvec3(position));
  return placed;
}

/// Each between three smoothed control hairs: a "mesh" whose triangles are those.
strands::Groom blended_at(const scene::Scene& scene, const StrandSet& set, const strands::Groom& control) {
  strands::Mesh hairs;
  hairs.positions.resize(control.strand_count());
  hairs.triangles = set.hairs;
  std::vector<strands::Root> roots;
  for (std::size_t s = 0; s < set.hairs.size(); ++s) roots.push_back({std::uint32_t(s), set.weights[s]});
  std::vector<std::uint32_t> itself(control.strand_count());
  std::iota(itself.begin(), itself.end(), 0u);
  strands::Groom drawn = strands::interpolate(strands::smooth(control, scene.strand_vertices), hairs, roots, itself);
  const auto count = std::size_t(scene.strand_vertices);
  for (std::size_t v = 0; v < drawn.vertex_count(); ++v)
    drawn.radii[v] = set.radius * (1 - set.taper * float(v % count) / float(count - 1));
  drawn.root_triangle.clear();
  drawn.root_barycentrics.clear();
  return drawn;
}

}  // namespace

strands::Groom drawn_strands_at(const scene::Scene& scene, const StrandSet& set, std::span<const glm::vec3> control,
                                const glm::dmat3& turn) {
  strands::Groom moved = set.control;
  moved.positions.assign(control.begin(), control.end());
  return scene::draws_as_given(scene) ? placed_at(set, std::move(moved), turn) : blended_at(scene, set, moved);
}

}  // namespace cuticle::plan
