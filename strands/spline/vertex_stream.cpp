#include "strands/spline/vertex_stream.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "strands/large.h"
#include "strands/spline/bezier.glslh"
#include "strands/spline/smooth.h"
#include "strands/tangent.glslh"

namespace cuticle::strands {

namespace {

constexpr float k_tip_radius = 0.5f;  // of the root's, as a generator's where nothing else is said

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

/// Rows of numbers along a smoothed hair, in the order of VertexStream::smoothed_.
struct HairRows {
  const float *x, *y, *z, *fraction;
  HairRows(const float* first, std::size_t size)
      : x(first), y(first + size), z(first + 2 * size), fraction(first + 3 * size) {}
  glm::vec3 point(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// A strand while it is made, in rows, so that the compiler makes vectors along it. Vertex i is at i + 1: each end has
/// itself beside it, for the tangents.
struct StrandRows {
  float x[k_max_vertices + 2], y[k_max_vertices + 2], z[k_max_vertices + 2], fraction[k_max_vertices + 2];

  glm::vec3 point(std::size_t place) const { return {x[place], y[place], z[place]}; }
  void set_point(std::size_t place, const glm::vec3& p) { x[place] = p.x, y[place] = p.y, z[place] = p.z; }

  void blend(const HairRows& a, const HairRows& b, const HairRows& c, const glm::vec3& weights, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      set_point(i + 1, blend_three<float>(a.point(i), b.point(i), c.point(i), weights));
      fraction[i + 1] = a.fraction[i] * weights.x + b.fraction[i] * weights.y + c.fraction[i] * weights.z;
    }
    set_point(0, point(1));
    set_point(size + 1, point(size));
  }

  void write(std::size_t size, float radius, glm::vec4* vertices, glm::vec4* tangents) const {
    const glm::vec3 root = point(1), tip = point(size);
    for (std::size_t i = 0; i < size; ++i) {
      const float along = fraction[i + 1];
      vertices[i] = {point(i + 1), radius * (1 - (1 - k_tip_radius) * along)};
      tangents[i] = {vertex_tangent<float>(point(i), point(i + 2), root, tip), along};
    }
  }
};

}  // namespace

Result<VertexStream> VertexStream::create(const Groom& control, int vertices_per_strand,
                                          std::span<const std::array<std::uint32_t, 3>> hairs,
                                          std::span<const glm::vec3> weights, float radius) {
  if (vertices_per_strand < 2 || vertices_per_strand > k_max_vertices)
    return bad_input(fmt::format("vertices per strand {}: allowed are 2 .. {}", vertices_per_strand, k_max_vertices));
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
  stream.smoothed_.resize(4 * control.strand_count() * stream.size_);
  for (std::vector<glm::vec4>* output : {&stream.vertices_, &stream.tangents_}) {
    reserve_large(*output, hairs.size() * stream.size_);
    output->resize(hairs.size() * stream.size_);
  }
  return stream;
}

void VertexStream::smooth_hair(std::size_t hair, std::span<const glm::vec3> control_positions) {
  const auto controls = control_positions.subspan(offsets_[hair], offsets_[hair + 1] - offsets_[hair]);
  const auto count = std::uint32_t(controls.size()), vertices = std::uint32_t(size_);
  thread_local std::vector<float> fractions;
  thread_local std::vector<glm::vec3> tangents;
  fractions.assign(count, 0);
  fractions_of(controls, fractions);
  tangents.resize(count);
  for (std::uint32_t k = 0; k < count; ++k) tangents[k] = tangent_at(controls, k);
  float* out = &smoothed_[4 * hair * size_];
  const auto put = [&](std::size_t i, const glm::vec3& point, float fraction) {
    for (int axis = 0; axis < 3; ++axis) out[std::size_t(axis) * size_ + i] = point[axis];
    out[3 * size_ + i] = fraction;
  };
  for (std::uint32_t i = 0; i < vertices; ++i) {
    if (count == 1) {
      put(i, controls[0], float(i) / float(vertices - 1));
      continue;
    }
    const std::uint32_t k = curve_segment(i, vertices, count);
    const float place = curve_place<float>(i, vertices, count);
    put(i, bezier_point<float>(controls[k], controls[k + 1], tangents[k], tangents[k + 1], place),
        std::min(fractions[k] * (1 - place) + fractions[k + 1] * place, 1.0f));
  }
}

void VertexStream::draw_strand(std::size_t strand) {
  const auto hair = [this, strand](std::size_t k) {
    return HairRows(&smoothed_[4 * hairs_[strand][k] * size_], size_);
  };
  StrandRows rows;
  rows.blend(hair(0), hair(1), hair(2), weights_[strand], size_);
  rows.write(size_, radius_, &vertices_[strand * size_], &tangents_[strand * size_]);
}

void VertexStream::update(std::span<const glm::vec3> control_positions) {
  CUTICLE_EXPECT(control_positions.size() == offsets_.back(), "one position for each control vertex");
  for_each(offsets_.size() - 1, [&](std::size_t hair) { smooth_hair(hair, control_positions); });
  for_each(hairs_.size(), [&](std::size_t strand) { draw_strand(strand); });
}

std::size_t VertexStream::bytes() const {
  const auto of = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
  return of(offsets_) + of(hairs_) + of(weights_) + of(smoothed_) + of(vertices_) + of(tangents_);
}

}  // namespace cuticle::strands
