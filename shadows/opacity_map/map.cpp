#include <cuticle/shadows/opacity_map/map.h>

#include <atomic>

#include <cuticle/shadows/detail/map_method.h>

namespace cuticle::shadows::opacity_map {
namespace {

/// Deposits a piece into the intervals between slices; sums of integers do not depend on their order.
void deposit(Map& map, std::span<const std::uint32_t> table, const Footprint<float>& footprint, int i, int j) {
  const glm::vec2 offset = texel_offset(footprint.from, i, j);
  const std::uint32_t amount = table[coverage_index(coverage(footprint, offset))];
  const int bin = std::max(0, depth_bin(footprint, offset));
  if (amount == 0 || bin >= int(map.layers)) return;
  const std::size_t t = std::size_t(j) * map.view.resolution + std::size_t(i);
  std::atomic_ref(map.sums[t * map.layers + std::size_t(bin)]).fetch_add(amount, std::memory_order_relaxed);
}

/// The sum at depth z of a texel, linear between its two nearest slices.
float sum_at(const Map& map, std::size_t texel, float z) {
  const float limited = std::min(z, float(map.layers));
  const std::uint32_t slice = std::min(std::uint32_t(limited), map.layers - 1);
  const std::uint32_t* sums = &map.sums[texel * map.layers];
  return between_planes(slice == 0 ? 0.0f : float(sums[slice - 1]), float(sums[slice]), limited - float(slice));
}

}  // namespace

Result<Settings> settings_from(const registry::ParameterValues& values) {
  Settings settings;
  settings.map = map_settings(values);
  settings.slices = std::uint32_t(values.integer("slices"));
  settings.printed_spacing = values.choice("spacing") == "printed";
  CUTICLE_TRY(check_map_bytes("opacity_map", settings.layers(), settings.map.resolution));
  return settings;
}

Map build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  const Accumulation& accumulation = settings.map.accumulation;
  Map map;
  map.view = map_view(axes, light_box(axes, groom.positions), settings.map.resolution, settings.intervals());
  map.layers = settings.layers();
  map.scale = fixed_point_scale(alpha, accumulation, groom.vertex_count() - groom.strand_count());
  map.sums.resize(std::size_t(settings.map.resolution) * settings.map.resolution * map.layers);
  const std::vector<std::uint32_t> table = deposit_table(alpha, accumulation, map.scale);
  for_each_piece(map.view, groom, 1.0f, [&](const Footprint<float>& footprint) {
    for_each_texel(footprint, map.view.resolution, [&](int i, int j) { deposit(map, table, footprint, i, j); });
  });
  sum_along_depth(map.sums, map.layers);
  return map;
}

std::vector<float> look_up(const Map& map, const Settings& settings, float filter, std::span<const glm::vec3> points) {
  const auto sum = [&](std::size_t texel, float z) { return sum_at(map, texel, z); };
  return look_up_points(map.view, settings.map, map.scale, filter, settings.intervals(), points, sum);
}

}  // namespace cuticle::shadows::opacity_map
