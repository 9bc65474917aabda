#pragma once
// The CPU's walk over a map of the light's view: the texels under a strand, and the texels that a lookup averages.
#include <atomic>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "shadows/filter.glslh"
#include "shadows/map_view.h"
#include "shadows/own_fibre.h"
#include "shadows/splat.glslh"
#include "strands/groom.h"

namespace cuticle::shadows {

/// body(i) for i = 0 .. count - 1, on all threads.
void for_each_index(std::size_t count, const auto& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
  });
}

/// Atomic sum and minimum of integers, which do not depend on their order.
inline void add_to(std::uint32_t& word, std::uint32_t value) {
  std::atomic_ref(word).fetch_add(value, std::memory_order_relaxed);
}
inline void lower_to(std::uint32_t& word, std::uint32_t value) {
  std::atomic_ref atomic(word);
  for (std::uint32_t old = atomic.load(std::memory_order_relaxed);
       value < old && !atomic.compare_exchange_weak(old, value, std::memory_order_relaxed);) {
  }
}

/// What lies in each of a texel's layers becomes what lies before its end.
inline void sum_along_depth(std::vector<std::uint32_t>& sums, std::size_t layers) {
  for_each_index(sums.size() / layers, [&](std::size_t texel) {
    for (std::size_t i = 1; i < layers; ++i) sums[texel * layers + i] += sums[texel * layers + i - 1];
  });
}

/// deposit(i, j) for every texel that the footprint may cover.
void for_each_texel(const MapView& view, const Footprint<float>& footprint, const auto& deposit) {
  const Reach<float> reach = footprint_reach(footprint);
  const int last_row = int(view.rows) - 1, last_column = int(view.columns) - 1;
  const int major_end = reach.steep ? last_row : last_column, minor_end = reach.steep ? last_column : last_row;
  for (int m = std::max(0, reach.first); m <= std::min(major_end, reach.last); ++m) {
    const int last = std::min(minor_end, minor_bound(footprint, reach, m, 1.0f));
    for (int n = std::max(0, minor_bound(footprint, reach, m, -1.0f)); n <= last; ++n)
      reach.steep ? deposit(n, m) : deposit(m, n);
  }
}

/// The segment of a strand that begins at vertex v, in the map.
struct SegmentInMap {
  glm::vec3 a{0}, b{0};
  float half_width = 0;
  float size() const { return segment_footprint(a, b, half_width, 0.0f, 0.0f).size; }
};
inline SegmentInMap segment_in_map(const MapView& view, const strands::Groom& groom, std::uint32_t v) {
  const glm::vec3 seen_a = view_point(view.axes, groom.positions[v]),
                  seen_b = view_point(view.axes, groom.positions[v + 1]);
  const auto place = [&](const glm::vec3& seen) {
    const glm::vec3 point = seen_to_map(view, seen);
    return glm::vec3(snap(point.x), snap(point.y), point.z);
  };
  return {place(seen_a), place(seen_b),
          0.5f * (groom.radii[v] + groom.radii[v + 1]) * view.scale.x * segment_scale(seen_a, seen_b, view.axes.reach)};
}

/// piece(footprint) for every piece of a segment of a strand, each at most 1 / steps_to_pieces depth steps deep.
void for_each_piece(const MapView& view, const strands::Groom& groom, std::uint32_t v, bool is_first, bool is_last,
                    float steps_to_pieces, const auto& piece) {
  const auto [a, b, half_width] = segment_in_map(view, groom, v);
  const float size = segment_footprint(a, b, half_width, 0.0f, 0.0f).size;
  const std::uint32_t pieces = piece_count(a.z * steps_to_pieces, b.z * steps_to_pieces, size);
  for (std::uint32_t i = 0; i < pieces; ++i)
    piece(segment_footprint(piece_point(a, b, i, pieces), piece_point(a, b, i + 1, pieces), half_width,
                            is_first && i == 0 ? 1.0f : 0.0f, is_last && i + 1 == pieces ? 1.0f : 0.0f));
}

/// piece(v, footprint) for every piece of every strand, v being the vertex that its segment begins at, on all threads;
/// the order is not defined.
void for_each_piece(const MapView& view, const strands::Groom& groom, float steps_to_pieces, const auto& piece) {
  for_each_index(groom.strand_count(), [&](std::size_t s) {
    const std::uint32_t first = groom.offsets[s], last = groom.offsets[s + 1] - 1;
    for (std::uint32_t v = first; v < last; ++v)
      for_each_piece(view, groom, v, v == first, v + 1 == last, steps_to_pieces,
                     [&](const Footprint<float>& footprint) { piece(v, footprint); });
  });
}

inline std::size_t texel_index(const MapView& view, int i, int j) {
  return std::size_t(j) * view.columns + std::size_t(i);
}

/// body(texel, coverage step, depth step) for every texel that a piece of a strand covers in part, on all threads.
void for_each_covered_texel(const MapView& view, const strands::Groom& groom, float steps_to_pieces, const auto& body) {
  for_each_piece(view, groom, steps_to_pieces, [&](std::uint32_t, const Footprint<float>& footprint) {
    for_each_texel(view, footprint, [&](int i, int j) {
      const glm::vec2 offset = texel_offset(footprint.from, i, j);
      const std::uint32_t covered = coverage_index(coverage(footprint, offset));
      if (covered > 0) body(texel_index(view, i, j), covered, std::uint32_t(std::max(0, depth_bin(footprint, offset))));
    });
  });
}

/// How a lookup averages.
struct MapFilter {
  float radius = 1;          ///< texels; under 0.5: the one texel that holds the point
  float metres = 0;          ///< the same where it is not 0: in a point light's view as many texels as it is wide there
  float depth_offset = 0;    ///< metres behind the point that fibres still count
  bool poisson = false;      ///< average the optical depth; else T
  bool knows_depths = true;  ///< MapSettings::knows_depths
};
/// The mean over the filter's disc around map point (x, y) of T = exp(exponent(texel, own)), texels outside the map
/// counting as free; `exponent` takes the index of a texel, and what the receiver's own fibre has left in it.
float mean_transmittance(const MapView& view, const MapFilter& filter, float x, float y, OwnFibre& own_fibre,
                         const auto& exponent) {
  const int j0 = int(std::floor(y)), reach = disc_reach(filter.radius);
  float sum = 0, weights = 0;
  for (int j = j0 - reach; j <= j0 + reach; ++j) {
    const float away = float(j) + 0.5f - y, half_row = disc_half_row(away, filter.radius);
    const int last = disc_last(x, half_row, filter.radius);
    const OwnFibre::Columns own = own_fibre.enter_row(j);
    for (int i = disc_first(x, half_row, filter.radius); i <= last; ++i) {
      const float beside = float(i) + 0.5f - x;
      const float weight = disc_weight(std::sqrt(beside * beside + away * away), filter.radius);
      const bool outside = i < 0 || j < 0 || i >= int(view.columns) || j >= int(view.rows);
      const bool may_own = i >= own.first && i <= own.last;
      const float value =
          outside ? 0.0f
                  : exponent(texel_index(view, i, j), may_own ? own_fibre.deposits(i) : std::span<const OwnDeposit>());
      sum += weight * (filter.poisson ? value : value == 0 ? 1.0f : std::exp(value));  // many texels are free
      weights += weight;
    }
  }
  return filter.poisson ? std::exp(sum / weights) : std::min(1.0f, sum / weights);
}

/// The depth of a point of the map for a lookup, in steps, limited to 0 .. deepest; `before`: metres
/// before it within which fibres do not count.
inline float depth_in_map(const MapView& view, const MapFilter& filter, float deepest, float z, float before) {
  return std::clamp(lookup_depth(z, filter.depth_offset - before, view.scale.z), 0.0f, deepest);
}

/// The filter at a point of the light's view.
inline MapFilter filter_there(const MapView& view, MapFilter filter, const glm::vec3& seen) {
  if (filter.metres > 0 && view.axes.reach > 0)
    filter.radius =
        std::clamp(filter.metres * view.scale.x * view_scale(seen, view.axes.reach), 0.5f, k_max_filter_radius);
  return filter;
}

/// Metres before a place, which the light sees at `seen`, within which fibres do not count: those that hold it, and
/// blur_depth() where a viewer sees it; not with a filter in metres, whose mean over the disc is what is asked for.
inline float free_depth(const MapView& view, const MapFilter& filter, const LookupPlace& place, const glm::vec3& seen) {
  const float texels_per_metre = view.scale.x * view_scale(seen, view.axes.reach);
  const bool is_blurred = place.is_seen && !(filter.metres > 0);
  const float share = filter.knows_depths ? 1 : k_interval_blur;
  return place.held + (is_blurred ? share * place.clearance * blur_depth(filter.radius, texels_per_metre) : 0);
}

/// The transmittance at a place in the world: 1 far outside the map. find_own(seen, point, radius) is called before,
/// for the pieces of `own_fibre`; at_depth(z), z in steps and limited to 0 .. deepest, gives the exponent as a function
/// of the texel and of what its own fibre has left there.
float transmittance_at(const MapView& view, const MapFilter& filter, float deepest, const LookupPlace& place,
                       OwnFibre& own_fibre, const auto& find_own, const auto& at_depth) {
  const glm::vec3 seen = view_point(view.axes, place.point), point = seen_to_map(view, seen);
  const float limit = float(std::max(view.columns, view.rows)) + 130.0f;
  if (!(std::abs(point.x) < limit && std::abs(point.y) < limit) || !is_seen_by_light(seen, view.axes.reach))
    return 1.0f;
  const MapFilter there = filter_there(view, filter, seen);
  const float z = depth_in_map(view, filter, deepest, point.z, free_depth(view, filter, place, seen));
  find_own(seen, glm::vec2(point), there.radius);
  return mean_transmittance(view, there, point.x, point.y, own_fibre, at_depth(z));
}

}  // namespace cuticle::shadows
