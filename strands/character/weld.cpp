#include "strands/character/assemble.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/geometric.hpp>

namespace cuticle::strands {

namespace {

/// The usable influences, greatest first.
std::vector<FileInfluence> usable(const FileVertex& vertex, CharacterReport& report) {
  std::vector<FileInfluence> kept;
  for (const FileInfluence& influence : vertex.influences) {
    if (influence.weight == 0) continue;
    const bool is_bad = !std::isfinite(influence.weight) || influence.weight < 0;
    report.bad_weights += is_bad;
    report.missing_joints += !is_bad && influence.is_missing;
    if (!is_bad && !influence.is_missing) kept.push_back(influence);
  }
  std::ranges::stable_sort(kept, std::greater(), &FileInfluence::weight);
  return kept;
}

double sum_of(std::span<const FileInfluence> influences) {
  double sum = 0;
  for (const FileInfluence& influence : influences) sum += double(influence.weight);
  return sum;
}

Influences influences_of(const FileVertex& vertex, CharacterReport& report) {
  Influences result;
  result.joints.fill(vertex.first_joint);
  std::vector<FileInfluence> kept = usable(vertex, report);
  if (kept.empty()) {
    ++report.unweighted_vertices;
    return result;
  }
  if (kept.size() > 4) {
    ++report.reduced_vertices;
    report.largest_weight_dropped = std::max(report.largest_weight_dropped, double(kept[4].weight) / sum_of(kept));
    kept.resize(4);
  }
  const double sum = sum_of(kept);
  result.weights = glm::vec4(0);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    result.joints[k] = kept[k].joint;
    result.weights[int(k)] = float(double(kept[k].weight) / sum);
  }
  return result;
}

bool agree(const Influences& a, const Influences& b) {
  return a.joints == b.joints && glm::distance(a.weights, b.weights) < 1e-4f;
}

bool has_area(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return glm::length(glm::cross(b - a, c - a)) > 0;
}

}  // namespace

void weld(std::span<const FileVertex> vertices, std::span<const std::array<std::uint32_t, 3>> triangles,
          Character& character) {
  Mesh& mesh = character.mesh;
  CharacterReport& report = character.report;
  report.file_vertices = vertices.size();
  std::map<std::array<float, 3>, std::uint32_t> places;
  std::vector<std::uint32_t> welded;
  for (const FileVertex& vertex : vertices) {
    const glm::vec3 p = vertex.position + 0.0f;  // -0 and 0 are one place
    const auto [found, is_new] = places.try_emplace({p.x, p.y, p.z}, std::uint32_t(mesh.positions.size()));
    const Influences influences = influences_of(vertex, report);
    welded.push_back(found->second);
    if (is_new) {
      mesh.positions.push_back(p);
      mesh.uv.push_back(vertex.uv);
      character.influences.push_back(influences);
    } else {
      report.welded_conflicts += !agree(influences, character.influences[found->second]);
    }
  }
  for (const auto& t : triangles) {
    const std::array<std::uint32_t, 3> corners{welded[t[0]], welded[t[1]], welded[t[2]]};
    if (has_area(mesh, corners))
      mesh.triangles.push_back(corners);
    else
      ++report.degenerate_triangles;
  }
  compute_normals(mesh);
}

}  // namespace cuticle::strands
