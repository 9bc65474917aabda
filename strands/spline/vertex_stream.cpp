#include <cuticle/strands/spline/vertex_stream.h>

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <cuticle/strands/spline/bezier.glslh>
#include <cuticle/strands/tangent.glslh>

namespace cuticle::strands {

namespace {

constexpr float k_tip_radius = 0.5f;  // of the root's, as on the device

template <class Work>
void for_each(std::size_t count, const Work& work) {
  constexpr std::size_t k_grain = 256;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, k_grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) work(i);
                    });
}

/// Length of the polyline up to each of its vertices, over the whole; even where it has no length.
void fractions_of(std::span<const glm::vec3> controls, std::span<float> fractions) {
  float sum = 0;
  for (std::size_t k = 1; k < controls.size(); ++k) fractions[k] = sum += glm::distance(controls[k - 1], controls[k]);
  for (std::size_t k = 1; k < controls.size(); ++k)
    fractions[k] = sum > 0 ? fractions[k] / sum : float(k) / float(controls.size() - 1);
}

glm::vec3 tangent_at(std::span<const glm::vec3> controls, std::size_t i) {
  return control_tangent<float>(controls[i == 0 ? 0 : i - 1], controls[i],
                                controls[std::min(i + 1, controls.size() - 1)]);
}

}  // namespace

Result<VertexStream> VertexStream::create(const Groom& control, int vertices_per_strand,
                                          std::span<const std::array<std::uint32_t, 3>> hairs,
                                          std::span<const glm::vec3> weights, float radius) {
  if (vertices_per_strand < 2 || vertices_per_strand > 64)
    return bad_input(fmt::format("vertices per strand {}: allowed are 2 .. 64", vertices_per_strand));
  if (hairs.size() != weights.size())
    return bad_input(fmt::format("{} triples of hairs, but {} of weights", hairs.size(), weights.size()));
  for (std::size_t s = 0; s < control.strand_count(); ++s)
    if (control.strand_size(s) == 0) return bad_input(fmt::format("control hair {} has no vertices", s));
  for (std::size_t s = 0; s < hairs.size(); ++s)
    if (std::ranges::max(hairs[s]) >= control.strand_count())
      return bad_input(
          fmt::format("drawn strand {}: control hair {} of {}", s, std::ranges::max(hairs[s]), control.strand_count()));
  VertexStream stream;
  stream.size_ = std::size_t(vertices_per_strand);
  stream.radius_ = radius;
  stream.offsets_ = control.offsets;
  stream.hairs_.assign(hairs.begin(), hairs.end());
  stream.weights_.assign(weights.begin(), weights.end());
  stream.smoothed_.resize(control.strand_count() * stream.size_);
  stream.vertices_.resize(hairs.size() * stream.size_);
  stream.tangents_.resize(hairs.size() * stream.size_);
  return stream;
}

void VertexStream::smooth_hair(std::size_t hair, std::span<const glm::vec3> control_positions) {
  const auto controls = control_positions.subspan(offsets_[hair], offsets_[hair + 1] - offsets_[hair]);
  const auto count = std::uint32_t(controls.size()), vertices = std::uint32_t(size_);
  thread_local std::vector<float> fractions;
  fractions.assign(count, 0);
  fractions_of(controls, fractions);
  for (std::uint32_t i = 0; i < vertices; ++i) {
    glm::vec4& out = smoothed_[hair * size_ + i];
    if (count == 1) {
      out = {controls[0], float(i) / float(vertices - 1)};
      continue;
    }
    const std::uint32_t segment = curve_segment(i, vertices, count);
    const float place = curve_place<float>(i, vertices, count);
    out = {bezier_point<float>(controls[segment], controls[segment + 1], tangent_at(controls, segment),
                               tangent_at(controls, segment + 1), place),
           std::min(fractions[segment] * (1 - place) + fractions[segment + 1] * place, 1.0f)};
  }
}

void VertexStream::blend_strand(std::size_t strand) {
  const auto& [a, b, c] = hairs_[strand];
  const glm::vec4 *first = &smoothed_[a * size_], *second = &smoothed_[b * size_], *third = &smoothed_[c * size_];
  const glm::vec3 weights = weights_[strand];
  glm::vec4 *vertex = &vertices_[strand * size_], *tangent = &tangents_[strand * size_];
  for (std::size_t i = 0; i < size_; ++i) {
    const glm::vec4 blended = first[i] * weights.x + second[i] * weights.y + third[i] * weights.z;
    vertex[i] = {blended.x, blended.y, blended.z, radius_ * (1 - (1 - k_tip_radius) * blended.w)};
    tangent[i].w = blended.w;
  }
}

void VertexStream::set_tangents(std::size_t strand) {
  const std::span<const glm::vec4> points(&vertices_[strand * size_], size_);
  glm::vec4* tangents = &tangents_[strand * size_];
  for (std::size_t i = 0; i < size_; ++i) {
    const glm::vec3 before(points[i == 0 ? 0 : i - 1]), after(points[std::min(i + 1, size_ - 1)]);
    const bool turns_back = before == after;  // only then do root and tip matter
    const glm::vec3 tangent = vertex_tangent<float>(before, after, turns_back ? glm::vec3(points[0]) : before,
                                                    turns_back ? glm::vec3(points[size_ - 1]) : after);
    tangents[i] = {tangent, tangents[i].w};
  }
}

void VertexStream::update(std::span<const glm::vec3> control_positions) {
  CUTICLE_EXPECT(control_positions.size() == offsets_.back(), "one position for each control vertex");
  for_each(offsets_.size() - 1, [&](std::size_t hair) { smooth_hair(hair, control_positions); });
  for_each(hairs_.size(), [&](std::size_t strand) {
    blend_strand(strand);
    set_tangents(strand);
  });
}

std::size_t VertexStream::bytes() const {
  const auto of = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
  return of(offsets_) + of(hairs_) + of(weights_) + of(smoothed_) + of(vertices_) + of(tangents_);
}

}  // namespace cuticle::strands
