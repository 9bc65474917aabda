#include "plan/drawn_strands.h"

#include <algorithm>
#include <numeric>

#include <glm/geometric.hpp>
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

/// In place of radii: shares of each control polygon's length, which smoothing and blending carry along.
void set_shares(strands::Groom& control) {
  for (std::size_t s = 0; s < control.strand_count(); ++s) {
    const auto length = float(strands::strand_length(control, s));
    float travelled = 0;
    for (std::uint32_t v = control.offsets[s]; v < control.offsets[s + 1]; ++v) {
      if (v > control.offsets[s]) travelled += glm::distance(control.positions[v - 1], control.positions[v]);
      control.radii[v] = length > 0 ? std::min(travelled / length, 1.0f) : 0.0f;
    }
  }
}

/// Each between three smoothed control hairs: a "mesh" whose triangles are those.
strands::Groom blended_at(const scene::Scene& scene, const StrandSet& set, strands::Groom control) {
  strands::Mesh hairs;
  hairs.positions.resize(control.strand_count());
  hairs.triangles = set.hairs;
  std::vector<strands::Root> roots;
  for (std::size_t s = 0; s < set.hairs.size(); ++s) roots.push_back({std::uint32_t(s), set.weights[s]});
  std::vector<std::uint32_t> itself(control.strand_count());
  std::iota(itself.begin(), itself.end(), 0u);
  set_shares(control);
  strands::Groom drawn = strands::interpolate(strands::smooth(control, scene.strand_vertices), hairs, roots, itself);
  for (float& radius : drawn.radii) radius = set.radius * (1 - set.taper * radius);
  drawn.root_triangle.clear();
  drawn.root_barycentrics.clear();
  return drawn;
}

}  // namespace

strands::Groom drawn_strands_at(const scene::Scene& scene, const StrandSet& set, std::span<const glm::vec3> control,
                                const glm::dmat3& turn) {
  strands::Groom moved = set.control;
  moved.positions.assign(control.begin(), control.end());
  return scene::draws_as_given(scene) ? placed_at(set, std::move(moved), turn)
                                      : blended_at(scene, set, std::move(moved));
}

}  // namespace cuticle::plan
