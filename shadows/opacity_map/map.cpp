#include <cuticle/shadows/opacity_map/map.h>

#include <atomic>
#include <cmath>

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cuticle/shadows/light_frame.glslh>
#include <cuticle/shadows/opacity_map/lookup.glslh>
#include <cuticle/shadows/opacity_map/splat.glslh>

namespace cuticle::shadows::opacity_map {
namespace {

constexpr double k_opaque_depth = 11.090354888959125;  // 16 ln 2
constexpr std::uint64_t k_most_bytes = 2ull << 30;

double optical_depth(double alpha, double covered, bool poisson) {
  if (poisson) return alpha * covered;
  return std::min(k_opaque_depth, -std::log1p(-alpha * covered));
}

glm::vec3 to_map(const Geometry& g, const glm::vec3& p) {
  return place_in_map(MapPlacement<float>{g.scale, g.offset}, light_point(g.axes.right, g.axes.up, g.axes.forward, p));
}

void parallel(std::size_t count, const auto& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
  });
}

/// Deposits segments into the intervals between slices; sums of integers do not depend on their order.
class Splatter {
 public:
  Splatter(Map& map, std::span<const std::uint32_t> table) : map_(map), table_(table) {}

  void strand(const strands::Groom& groom, std::size_t s) {
    const std::uint32_t first = groom.offsets[s], last = groom.offsets[s + 1] - 1;
    for (std::uint32_t v = first; v < last; ++v)
      segment(place(groom.positions[v]), place(groom.positions[v + 1]),
              0.5f * (groom.radii[v] + groom.radii[v + 1]) * map_.geometry.scale.x, v == first, v + 1 == last);
  }

 private:
  glm::vec3 place(const glm::vec3& p) const {
    const glm::vec3 point = to_map(map_.geometry, p);
    return {snap(point.x), snap(point.y), point.z};
  }

  void segment(const glm::vec3& a, const glm::vec3& b, float half_width, bool is_first, bool is_last) {
    const std::uint32_t pieces = piece_count(a.z, b.z, segment_footprint(a, b, half_width, 0.0f, 0.0f).size);
    for (std::uint32_t i = 0; i < pieces; ++i) {
      const float round_a = is_first && i == 0 ? 1.0f : 0.0f, round_b = is_last && i + 1 == pieces ? 1.0f : 0.0f;
      piece(segment_footprint(piece_point(a, b, i, pieces), piece_point(a, b, i + 1, pieces), half_width, round_a, round_b));
    }
  }

  void piece(const Footprint<float>& footprint) {
    const Reach<float> reach = footprint_reach(footprint);
    const int end = int(map_.geometry.resolution) - 1;
    for (int m = std::max(0, reach.first); m <= std::min(end, reach.last); ++m) {
      const int last = std::min(end, minor_bound(footprint, reach, m, 1.0f));
      for (int n = std::max(0, minor_bound(footprint, reach, m, -1.0f)); n <= last; ++n)
        reach.steep ? texel(footprint, n, m) : texel(footprint, m, n);
    }
  }

  void texel(const Footprint<float>& footprint, int i, int j) {
    const glm::vec2 offset = texel_offset(footprint.from, i, j);
    const std::uint32_t amount = table_[coverage_index(coverage(footprint, offset))];
    const int bin = std::max(0, depth_bin(footprint, offset));
    if (amount == 0 || bin >= int(map_.geometry.layers)) return;
    const std::size_t t = std::size_t(j) * map_.geometry.resolution + std::size_t(i);
    std::atomic_ref(map_.sums[t * map_.geometry.layers + std::size_t(bin)]).fetch_add(amount, std::memory_order_relaxed);
  }

  Map& map_;
  std::span<const std::uint32_t> table_;
};

void sum_along_depth(Map& map) {
  const std::size_t layers = map.geometry.layers;
  parallel(map.sums.size() / layers, [&](std::size_t t) {
    for (std::size_t i = 1; i < layers; ++i) map.sums[t * layers + i] += map.sums[t * layers + i - 1];
  });
}

/// The lookup of one point: a weighted mean over texels of T, or of sigma.
class Lookup {
 public:
  Lookup(const Map& map, const Settings& settings, float filter)
      : map_(map), filter_(filter), per_unit_(float(-settings.k / map.scale)), poisson_(settings.poisson) {}

  float at(const glm::vec3& p) const {
    const Geometry& g = map_.geometry;
    const glm::vec3 point = to_map(g, p);
    const float limit = float(g.resolution) + 130.0f;
    if (!(std::abs(point.x) < limit && std::abs(point.y) < limit)) return 1.0f;
    return mean(point.x, point.y, std::clamp(point.z, 0.0f, float(g.layers)));
  }

 private:
  float mean(float x, float y, float z) const {
    const int i0 = int(std::floor(x)), j0 = int(std::floor(y)), reach = disc_reach(filter_);
    float sum = 0, weights = 0;
    for (int j = j0 - reach; j <= j0 + reach; ++j)
      for (int i = i0 - reach; i <= i0 + reach; ++i) {
        const float weight = disc_weight(std::hypot(float(i) + 0.5f - x, float(j) + 0.5f - y), filter_);
        if (weight > 0) sum += weight * averaged(i, j, z);
        weights += weight;
      }
    return poisson_ ? std::exp(sum / weights) : std::min(1.0f, sum / weights);
  }

  /// What is averaged: -k sigma, or exp(-k sigma).
  float averaged(int i, int j, float z) const {
    const int end = int(map_.geometry.resolution);
    const float exponent = i < 0 || j < 0 || i >= end || j >= end ? 0.0f : per_unit_ * between(i, j, z);
    return poisson_ ? exponent : std::exp(exponent);
  }

  float between(int i, int j, float z) const {
    const int layers = int(map_.geometry.layers), slice = std::min(int(z), layers - 1);
    const std::uint32_t* sums = &map_.sums[(std::size_t(j) * map_.geometry.resolution + std::size_t(i)) * std::size_t(layers)];
    const float nearer = slice == 0 ? 0.0f : float(sums[slice - 1]);
    return between_slices(nearer, float(sums[slice]), z - float(slice));
  }

  const Map& map_;
  float filter_, per_unit_;
  bool poisson_;
};

}  // namespace

Result<Settings> settings_from(const registry::ParameterValues& values) {
  Settings settings;
  settings.slices = std::uint32_t(values.integer("slices"));
  settings.resolution = std::uint32_t(values.integer("resolution"));
  settings.k = values.real("k");
  settings.filter_texels = values.real("filter_texels");
  settings.filter_radius = 1e-3 * values.real("filter_radius_mm");
  settings.poisson = values.choice("accumulate") == "poisson";
  settings.printed_spacing = values.choice("spacing") == "printed";
  const std::uint64_t bytes = 4ull * (settings.slices - 1) * settings.resolution * settings.resolution;
  if (bytes > k_most_bytes)
    return usage_error(fmt::format("opacity_map: {} slices at resolution {} need {} bytes, more than {}", settings.slices,
                                   settings.resolution, bytes, k_most_bytes), "fewer slices or a lower resolution");
  return settings;
}

float slice_intervals(const Settings& settings) {
  return float(settings.printed_spacing ? settings.slices : settings.slices - 1);
}

Geometry map_geometry(const LightAxes& axes, const LightBox& box, const Settings& settings) {
  const MapPlacement<float> placement = map_placement(box.lower, box.upper, settings.resolution, slice_intervals(settings));
  return {axes, placement.scale, placement.offset, settings.resolution, settings.slices - 1};
}

Result<float> filter_texels(const Geometry& geometry, const Settings& settings) {
  const double given = settings.filter_radius > 0 ? std::max(0.5, settings.filter_radius * double(geometry.scale.x)) : settings.filter_texels;
  if (given > 64)
    return usage_error(fmt::format("opacity_map: the filter's radius is {:.0f} texels, more than 64", given),
                       "a smaller filter_radius_mm or a lower resolution");
  return float(given);
}

double fixed_point_scale(double alpha, const Settings& settings, std::size_t segments) {
  const double most = double(std::max<std::size_t>(segments, 1)) * optical_depth(alpha, 1, settings.poisson) / settings.k;
  const double exponent = std::floor(std::log2(4294967295.0 / std::max(most, 1e-9)));
  return std::exp2(std::clamp(exponent, 12.0, 20.0));
}

std::vector<std::uint32_t> deposit_table(double alpha, const Settings& settings, double scale) {
  std::vector<std::uint32_t> table(k_coverage_steps + 1);
  for (std::uint32_t i = 0; i <= k_coverage_steps; ++i)
    table[i] = std::uint32_t(std::lround(scale / settings.k * optical_depth(alpha, double(i) / k_coverage_steps, settings.poisson)));
  return table;
}

Map build_map(const strands::Groom& groom, double alpha, const Geometry& geometry, const Settings& settings) {
  Map map;
  map.geometry = geometry;
  map.scale = fixed_point_scale(alpha, settings, groom.vertex_count() - groom.strand_count());
  map.sums.resize(std::size_t(settings.resolution) * settings.resolution * map.geometry.layers);
  const std::vector<std::uint32_t> table = deposit_table(alpha, settings, map.scale);
  Splatter splatter(map, table);
  parallel(groom.strand_count(), [&](std::size_t s) { splatter.strand(groom, s); });
  sum_along_depth(map);
  return map;
}

std::vector<float> look_up(const Map& map, const Settings& settings, float filter, std::span<const glm::vec3> points) {
  std::vector<float> values(points.size());
  const Lookup lookup(map, settings, filter);
  parallel(points.size(), [&](std::size_t i) { values[i] = lookup.at(points[i]); });
  return values;
}

}  // namespace cuticle::shadows::opacity_map
