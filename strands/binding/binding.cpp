#include "strands/binding/binding.h"

#include "strands/binding/nearest_triangle.h"
#include "strands/binding/surface_frame.glslh"

namespace cuticle::strands {

namespace {

template <class Corners>
SurfaceFrame<float> frame_on(const Mesh& mesh, const Corners& t, const glm::vec3& weights) {
  return surface_frame<float>(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]], mesh.normals[t[0]],
                              mesh.normals[t[1]], mesh.normals[t[2]], weights);
}

}  // namespace

Result<Binding> bind_roots(const Groom& groom, const Mesh& mesh, double far) {
  const NearestTriangle nearest(mesh);
  if (nearest.empty()) return bad_input("growth mesh: no triangle has area, at least 1 is needed");
  Binding binding;
  binding.report.degenerate_triangles = nearest.degenerate_triangles();
  std::vector<double> distances;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    binding.roots.emplace_back();
    if (groom.strand_size(s) == 0) {
      ++binding.report.empty_strands;
      continue;
    }
    const MeshPoint found = nearest.at(glm::dvec3(groom.strand(s)[0]));
    binding.roots.back() = {found.triangle, glm::vec3(found.weights)};
    distances.push_back(found.distance);
    binding.report.far_strands += found.distance > far;
  }
  binding.report.distance = spread(std::move(distances));
  return binding;
}

Mesh mesh_at_roots(const Mesh& mesh, std::span<const Root> roots) {
  Mesh at;
  for (const Root& root : roots) {
    const auto& t = mesh.triangles[root.triangle];
    at.positions.push_back(frame_on(mesh, t, root.weights).origin);
    at.normals.push_back(mean_normal<float>(mesh.normals[t[0]], mesh.normals[t[1]], mesh.normals[t[2]], root.weights));
  }
  return at;
}

void move_roots_onto(Groom& groom, const Mesh& mesh, std::span<const Root> roots) {
  CUTICLE_EXPECT(roots.size() == groom.strand_count(), "one root for each strand");
  const Mesh at = mesh_at_roots(mesh, roots);
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    if (groom.strand_size(s) == 0) continue;
    const glm::vec3 shift = at.positions[s] - groom.positions[groom.offsets[s]];
    for (std::size_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v) groom.positions[v] += shift;
  }
}

RestOnMesh rest_on_mesh(const Groom& groom, const Mesh& mesh, std::span<const Root> roots) {
  CUTICLE_EXPECT(roots.size() == groom.strand_count(), "one root for each strand");
  RestOnMesh rest;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const auto& t = mesh.triangles[roots[s].triangle];
    rest.corners.push_back({t[0], t[1], t[2], 0});
    rest.weights.emplace_back(roots[s].weights, 0);
    const SurfaceFrame<float> frame = frame_on(mesh, t, roots[s].weights);
    for (const glm::vec3& point : groom.strand(s)) {
      rest.locals.emplace_back(to_frame(frame, point), 0);
      rest.strand_of.push_back(std::uint32_t(s));
    }
  }
  return rest;
}

void carry(const RestOnMesh& rest, const Mesh& moved, std::span<glm::vec3> positions) {
  CUTICLE_EXPECT(positions.size() == rest.locals.size(), "one position for each vertex of the rest");
  std::size_t v = 0;
  for (std::size_t s = 0; s < rest.corners.size(); ++s) {
    const SurfaceFrame<float> frame = frame_on(moved, rest.corners[s], glm::vec3(rest.weights[s]));
    for (; v < rest.strand_of.size() && rest.strand_of[v] == s; ++v)
      positions[v] = from_frame(frame, glm::vec3(rest.locals[v]));
  }
}

}  // namespace cuticle::strands
