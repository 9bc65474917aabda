// N5 and its alternative: strands between smoothed hairs.
#include <algorithm>

#include "strands/spline/frames.h"
#include "strands/spline/smooth.h"
#include "strands/spline/bezier.glslh"

namespace cuticle::strands {

namespace {

/// The three smoothed hairs that a root lies between.
using HairsAround = std::array<std::uint32_t, 3>;

HairsAround hairs_around(const Mesh& scalp, const Root& root, std::span<const std::uint32_t> hair_of_vertex) {
  const auto& triangle = scalp.triangles[root.triangle];
  return {hair_of_vertex[triangle[0]], hair_of_vertex[triangle[1]], hair_of_vertex[triangle[2]]};
}

/// Weighted sums of `size` numbers that begin at each of three places.
void append_sums(std::span<const float> values, const std::array<std::size_t, 3>& first, std::size_t size,
                 const glm::vec3& weights, std::vector<float>& out) {
  for (std::size_t k = 0; k < size; ++k)
    out.push_back(values[first[0] + k] * weights.x + values[first[1] + k] * weights.y +
                  values[first[2] + k] * weights.z);
}

void append_attributes(const Groom& smoothed, const HairsAround& hairs, const glm::vec3& weights, Groom& out) {
  for (const auto& [name, attribute] : smoothed.attributes) {
    const auto components = std::size_t(attribute.components);
    const bool per_strand = attribute.domain == Attribute::Domain::strand;
    std::array<std::size_t, 3> first{};
    for (std::size_t c = 0; c < 3; ++c) first[c] = components * (per_strand ? hairs[c] : smoothed.offsets[hairs[c]]);
    const std::size_t size = components * (per_strand ? 1 : smoothed.strand_size(hairs[0]));
    Attribute& result =
        out.attributes.try_emplace(name, Attribute{attribute.domain, attribute.components, {}}).first->second;
    append_sums(attribute.values, first, size, weights, result.values);
  }
}

/// All of a strand but its positions.
void append_rest(const Groom& smoothed, const HairsAround& hairs, const Root& root, Groom& out) {
  const std::array<std::size_t, 3> first{smoothed.offsets[hairs[0]], smoothed.offsets[hairs[1]],
                                         smoothed.offsets[hairs[2]]};
  append_sums(smoothed.radii, first, smoothed.strand_size(hairs[0]), root.weights, out.radii);
  append_attributes(smoothed, hairs, root.weights, out);
  out.offsets.push_back(std::uint32_t(out.positions.size()));
  out.root_triangle.push_back(root.triangle);
  out.root_barycentrics.emplace_back(root.weights.y, root.weights.z);
}

void append_blend(const Groom& smoothed, const HairsAround& hairs, const glm::vec3& weights, Groom& out) {
  const auto a = smoothed.strand(hairs[0]), b = smoothed.strand(hairs[1]), c = smoothed.strand(hairs[2]);
  for (std::size_t i = 0; i < a.size(); ++i) out.positions.push_back(blend_three<float>(a[i], b[i], c[i], weights));
}

/// A vector in a hair's frame at its root, carried along the hair.
void append_carried(std::span<const glm::vec3> hair, const StrandFrames& frames, const glm::vec3& offset, Groom& out) {
  const glm::vec3 local(glm::dot(offset, frames.normals[0]), glm::dot(offset, frames.binormals[0]),
                        glm::dot(offset, frames.tangents[0]));
  for (std::size_t i = 0; i < hair.size(); ++i)
    out.positions.push_back(hair[i] + frames.normals[i] * local.x + frames.binormals[i] * local.y +
                            frames.tangents[i] * local.z);
}

std::uint32_t greatest(const glm::vec3& weights) {
  const std::uint32_t first = weights.y > weights.x ? 1 : 0;
  return weights.z > weights[int(first)] ? 2 : first;
}

Groom reserved(const Groom& smoothed, std::size_t strands) {
  Groom result;
  const std::size_t size = smoothed.strand_count() == 0 ? 0 : smoothed.strand_size(0);
  result.offsets.reserve(strands + 1);
  result.positions.reserve(strands * size);
  result.radii.reserve(strands * size);
  return result;
}

}  // namespace

Groom interpolate(const Groom& smoothed, const Mesh& scalp, std::span<const Root> roots,
                  std::span<const std::uint32_t> hair_of_vertex) {
  CUTICLE_EXPECT(hair_of_vertex.size() == scalp.positions.size(), "one hair per scalp vertex");
  Groom result = reserved(smoothed, roots.size());
  for (const Root& root : roots) {
    const HairsAround hairs = hairs_around(scalp, root, hair_of_vertex);
    append_blend(smoothed, hairs, root.weights, result);
    append_rest(smoothed, hairs, root, result);
  }
  return result;
}

Groom follow(const Groom& smoothed, const Mesh& scalp, std::span<const Root> roots,
             std::span<const std::uint32_t> hair_of_vertex) {
  CUTICLE_EXPECT(hair_of_vertex.size() == scalp.positions.size(), "one hair per scalp vertex");
  std::vector<StrandFrames> frames(smoothed.strand_count());
  Groom result = reserved(smoothed, roots.size());
  for (const Root& root : roots) {
    const HairsAround hairs = hairs_around(scalp, root, hair_of_vertex);
    const std::uint32_t guide = hairs[greatest(root.weights)];
    const auto hair = smoothed.strand(guide);
    const glm::vec3 own_root = blend_three<float>(smoothed.strand(hairs[0])[0], smoothed.strand(hairs[1])[0],
                                                  smoothed.strand(hairs[2])[0], root.weights);
    const glm::vec3 offset = own_root - hair[0];
    if (frames[guide].tangents.empty()) frames[guide] = frames_along(hair, offset);
    append_carried(hair, frames[guide], offset, result);
    append_rest(smoothed, hairs, root, result);
  }
  return result;
}

}  // namespace cuticle::strands
