#include "shadows/opacity_map/map.h"

#include <bit>

#include <fmt/core.h>

#include "shadows/detail/map_method.h"

namespace cuticle::shadows::opacity_map {
namespace {

/// The sum at depth z of a texel, linear between its two nearest slices.
float sum_at(const Map& map, std::size_t texel, float z) {
  const float limited = std::min(z, float(map.layers));
  const std::uint32_t slice = std::min(std::uint32_t(limited), map.layers - 1);
  const std::uint32_t* sums = &map.sums[texel * map.layers];
  return between_planes(slice == 0 ? 0.0f : float(sums[slice - 1]), float(sums[slice]), limited - float(slice));
}

/// To the 11 significant bits of a half float, ties to even.
std::uint32_t rounded_to_half(std::uint32_t sum) {
  const int dropped = int(std::bit_width(sum)) - 11;
  if (dropped <= 0) return sum;
  const std::uint32_t half = 1u << (dropped - 1), odd = (sum >> dropped) & 1u;
  return ((sum + half - 1 + odd) >> dropped) << dropped;
}

/// Tent weights are linear in sigma: interpolated between the depths of two vertices they give what lies as far between
/// sigma at either depth.
Result<std::vector<float>> look_up_by_vertex(const Map& map, const Settings& settings, const Receivers& receivers) {
  CUTICLE_ASSIGN(const MapFilter filter, map_filter(map.view, settings.map));
  const float per_unit = exponent_per_unit(settings.map, map.scale), deepest = settings.intervals();
  const auto depth_of = [&](const glm::vec3& p) {
    return depth_in_map(map.view, filter, deepest, to_map(map.view, p).z);
  };
  std::vector<float> values(receivers.points.size());
  for_each_index(values.size(), [&](std::size_t i) {
    const SegmentPlace& place = receivers.segments[i];
    const float from = depth_of(place.from), to = depth_of(place.to);
    values[i] = transmittance_at(map.view, filter, deepest, receivers.points[i], [&](float) {
      return [&](std::size_t texel) {
        return per_unit * between_planes(sum_at(map, texel, from), sum_at(map, texel, to), place.fraction);
      };
    });
  });
  return values;
}

double scale_of(const strands::Groom& groom, double alpha, const Settings& settings) {
  if (settings.form == Form::graphics_8bit) return 255;
  return fixed_point_scale(alpha, settings.map.accumulation, groom.vertex_count() - groom.strand_count());
}

/// What the form's format leaves of the sums.
void store(Form form, Map& map) {
  const std::size_t bytes = form == Form::compute ? 4 : form == Form::graphics_half ? 2 : 1;
  map.texel_bytes = bytes * (form == Form::compute ? map.layers : k_target_planes);
  if (form == Form::graphics_8bit)
    for (std::uint32_t& sum : map.sums) {
      map.clamped += sum > 255;
      sum = std::min(sum, 255u);
    }
  if (form == Form::graphics_half)
    for (std::uint32_t& sum : map.sums) sum = rounded_to_half(sum);
}

}  // namespace

Result<Settings> settings_from(const registry::ParameterValues& values) {
  Settings settings;
  settings.map = map_settings("opacity_map", values);
  settings.slices = std::uint32_t(values.integer("slices"));
  settings.vertex_weights = values.choice("weights") == "per_vertex";
  settings.printed_spacing = values.choice("spacing") == "printed";
  const std::string& form = values.choice("form");
  settings.form = form == "compute"         ? Form::compute
                  : form == "graphics_8bit" ? Form::graphics_8bit
                                            : Form::graphics_half;
  if (settings.form != Form::compute && settings.layers() > k_target_planes)
    return usage_error(fmt::format("opacity_map: {} slices are outside 2 .. {} of form={}", settings.slices,
                                   k_target_planes + 1, form),
                       "form=compute, or fewer slices");
  CUTICLE_TRY(check_map_bytes(settings.map, settings.layers()));
  return settings;
}

Map build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  const Accumulation& accumulation = settings.map.accumulation;
  Map map;
  map.view = map_view(axes, light_box(axes, groom.positions), settings.map.resolution, settings.intervals(),
                      settings.form == Form::compute ? k_any_shape : k_square_shape);
  map.layers = settings.layers();
  map.scale = scale_of(groom, alpha, settings);
  map.sums.resize(map.view.texels() * map.layers);
  const std::vector<std::uint32_t> table = deposit_table(alpha, accumulation, map.scale);
  for_each_covered_texel(map.view, groom, 1.0f, [&](std::size_t texel, std::uint32_t covered, std::uint32_t step) {
    if (step < map.layers) add_to(map.sums[texel * map.layers + step], table[covered]);
  });
  sum_along_depth(map.sums, map.layers);
  store(settings.form, map);
  return map;
}

Result<std::vector<float>> look_up(const Map& map, const Settings& settings, const Receivers& receivers) {
  if (settings.vertex_weights && !receivers.segments.empty()) return look_up_by_vertex(map, settings, receivers);
  const float per_unit = exponent_per_unit(settings.map, map.scale);
  const auto at_depth = [&](float z) { return [&, z](std::size_t texel) { return per_unit * sum_at(map, texel, z); }; };
  return look_up_points(map.view, settings.map, settings.intervals(), receivers.points, at_depth);
}

}  // namespace cuticle::shadows::opacity_map
