#include <cuticle/strands/spline/smooth.h>

#include <algorithm>

#include <cuticle/strands/spline/bezier.glslh>

namespace cuticle::strands {

namespace {

glm::vec3 tangent_at(std::span<const glm::vec3> hair, std::size_t i) {
  return control_tangent<float>(hair[i == 0 ? 0 : i - 1], hair[i], hair[std::min(i + 1, hair.size() - 1)]);
}

glm::vec3 point_at(std::span<const glm::vec3> hair, std::uint32_t vertex, std::uint32_t vertices) {
  if (hair.size() == 1) return hair[0];
  const std::uint32_t controls = std::uint32_t(hair.size());
  const std::uint32_t segment = curve_segment(vertex, vertices, controls);
  const float place = curve_place<float>(vertex, vertices, controls);
  return bezier_point<float>(hair[segment], hair[segment + 1], tangent_at(hair, segment), tangent_at(hair, segment + 1),
                             place);
}

float radius_at(std::span<const float> radii, std::uint32_t vertex, std::uint32_t vertices) {
  if (radii.size() == 1) return radii[0];
  const std::uint32_t controls = std::uint32_t(radii.size());
  const std::uint32_t segment = curve_segment(vertex, vertices, controls);
  const float place = curve_place<float>(vertex, vertices, controls);
  return radii[segment] * (1 - place) + radii[segment + 1] * place;
}

std::vector<std::uint32_t> even_offsets(std::size_t strands, std::uint32_t vertices) {
  std::vector<std::uint32_t> offsets(strands + 1);
  for (std::size_t s = 0; s < offsets.size(); ++s) offsets[s] = std::uint32_t(s * vertices);
  return offsets;
}

/// The smoothed hairs of a root's three corners.
std::array<std::uint32_t, 3> hairs_of(const Mesh& scalp, const Root& root,
                                      std::span<const std::uint32_t> hair_of_vertex) {
  const auto& triangle = scalp.triangles[root.triangle];
  return {hair_of_vertex[triangle[0]], hair_of_vertex[triangle[1]], hair_of_vertex[triangle[2]]};
}

void append_blend(const Groom& smoothed, const std::array<std::uint32_t, 3>& hairs, const glm::vec3& weights,
                  Groom& out) {
  const std::size_t size = smoothed.strand_size(hairs[0]);
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t a = smoothed.offsets[hairs[0]] + i, b = smoothed.offsets[hairs[1]] + i,
                      c = smoothed.offsets[hairs[2]] + i;
    out.positions.push_back(
        blend_three<float>(smoothed.positions[a], smoothed.positions[b], smoothed.positions[c], weights));
    out.radii.push_back(smoothed.radii[a] * weights.x + smoothed.radii[b] * weights.y + smoothed.radii[c] * weights.z);
  }
  out.offsets.push_back(std::uint32_t(out.positions.size()));
}

}  // namespace

Groom smooth(const Groom& control, int vertices) {
  CUTICLE_EXPECT(vertices >= 2 && vertices <= 64, "vertices per strand outside 2 .. 64");
  const auto count = std::uint32_t(vertices);
  Groom result;
  result.offsets = even_offsets(control.strand_count(), count);
  result.root_uv = control.root_uv;
  result.root_triangle = control.root_triangle;
  result.root_barycentrics = control.root_barycentrics;
  for (std::size_t s = 0; s < control.strand_count(); ++s) {
    const std::span<const float> radii(control.radii.data() + control.offsets[s], control.strand_size(s));
    for (std::uint32_t i = 0; i < count; ++i) {
      result.positions.push_back(point_at(control.strand(s), i, count));
      result.radii.push_back(radius_at(radii, i, count));
    }
  }
  return result;
}

Groom interpolate(const Groom& smoothed, const Mesh& scalp, std::span<const Root> roots,
                  std::span<const std::uint32_t> hair_of_vertex) {
  CUTICLE_EXPECT(hair_of_vertex.size() == scalp.positions.size(), "one hair per scalp vertex");
  Groom result;
  for (const Root& root : roots) {
    append_blend(smoothed, hairs_of(scalp, root, hair_of_vertex), root.weights, result);
    result.root_triangle.push_back(root.triangle);
    result.root_barycentrics.emplace_back(root.weights.y, root.weights.z);
  }
  return result;
}

}  // namespace cuticle::strands
