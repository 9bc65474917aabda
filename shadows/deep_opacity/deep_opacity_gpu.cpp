// Deep opacity maps on the GPU: clear (fills), fit, nearest, histogram, layers, splat, scan, lookup; the integers of
// the map equal the CPU's.
#include <cuticle/shadows/deep_opacity/deep_map.h>
#include <cuticle/shadows/map_shadow_gpu.h>
#include <cuticle/shadows/splat.glslh>

#include <deep_histogram_comp.spv.h>
#include <deep_layers_comp.spv.h>
#include <deep_lookup_comp.spv.h>
#include <deep_splat_comp.spv.h>

namespace cuticle::shadows::deep_opacity {
namespace {

constexpr std::uint32_t k_equal_opacity_flag = 2;  // k_equal_opacity of deep_layers.comp
enum Own : int { k_sums = k_own, k_nearest, k_ends, k_histogram };

MapDescription describe(const Settings& settings) {
  const std::uint64_t texels = std::uint64_t(settings.map.resolution) * settings.map.resolution;
  MapDescription map;
  map.settings = settings.map;
  map.intervals = float(k_depth_steps);
  map.layers = settings.layers;
  map.flags = settings.spacing == Spacing::equal_opacity ? k_equal_opacity_flag : 0;
  map.pieces_per_step = k_pieces_per_step;
  map.after_deposits = layer_shares(settings);
  map.buffers = {
      {texels * settings.layers}, {texels, k_no_depth}, {k_most_layers, 0, false}, {k_depth_steps, 0, false}};
  map.passes = {
      {"shadow.nearest", map_nearest_code(), {k_vertices, k_segments, k_box, k_nearest}},
      {"shadow.histogram", deep_histogram_comp, {k_vertices, k_segments, k_box, k_nearest, k_histogram}},
      {"shadow.layers", deep_layers_comp, {k_deposits, k_histogram, k_ends}, MapRun::one_group},
      {"shadow.splat", deep_splat_comp, {k_vertices, k_segments, k_box, k_deposits, k_nearest, k_ends, k_sums}},
      {"shadow.scan", map_scan_code(), {k_sums}, MapRun::per_texel},
      {"shadow.lookup",
       deep_lookup_comp,
       {k_vertices, k_box, k_nearest, k_ends, k_sums, k_transmittance},
       MapRun::per_vertex}};
  return map;
}

/// Bytes are packed on the CPU only.
Result<Settings> device_settings_from(const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(const Settings settings, settings_from(values));
  if (settings.bytes) return usage_error("deep_opacity: storage=bytes has no GPU half", "storage=words");
  return settings;
}

MapWords words_of(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  Map map = build_map(groom, alpha, axes, settings);
  return {std::move(map.sums), std::move(map.nearest), {map.ends.end, map.ends.end + map.ends.count}};
}

}  // namespace

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"deep_opacity", create_map<device_settings_from, describe>,
                                words_of_map<device_settings_from, words_of>};
  return method;
}

}  // namespace cuticle::shadows::deep_opacity
