// N17 on the GPU: clear (fills), fit, splat, scan, lookup; the integers of its map equal the CPU's. N18: fit, draw,
// lookup.
#include "shadows/map_shadow_gpu.h"
#include "shadows/opacity_map/map.h"

#include <opacity_draw_frag.spv.h>
#include <opacity_draw_vert.spv.h>
#include <opacity_lookup_comp.spv.h>
#include <opacity_splat_comp.spv.h>
#include <opacity_target_lookup_comp.spv.h>

namespace cuticle::shadows::opacity_map {
namespace {

constexpr int k_sums = k_own, k_fibre = k_own + 1;
constexpr std::uint32_t k_scattered_flag = 4;  // k_scattered of opacity_lookup.comp

/// N18: what is drawn, and the lookup of the targets.
MapDescription describe_drawn(const Settings& settings) {
  MapDescription map;
  map.settings = settings.map;
  map.intervals = settings.intervals();
  map.layers = settings.layers();
  map.own = {float(settings.map.accumulation.k)};
  map.drawing = {opacity_draw_vert, opacity_draw_frag, k_target_planes / 4,
                 settings.form == Form::graphics_8bit ? gpu::TextureFormat::rgba8 : gpu::TextureFormat::rgba16f};
  map.passes = {{"shadow.lookup",
                 opacity_target_lookup_comp,
                 {k_vertices, k_segments, k_box, k_deposits, k_transmittance, k_receivers},
                 MapRun::per_vertex,
                 /*reads_targets=*/true}};
  return map;
}

MapDescription describe_computed(const Settings& settings) {
  MapDescription map;
  map.settings = settings.map;
  map.intervals = settings.intervals();
  map.layers = settings.layers();
  map.flags = settings.is_scattered() ? k_scattered_flag : 0;
  map.buffers = {{.per_strip = true}, {.words = std::tuple_size_v<FibreSums>, .kept = false}};
  map.passes = {{"shadow.splat",
                 opacity_splat_comp,
                 {k_vertices, k_segments, k_box, k_deposits, k_sums, k_fibre},
                 MapRun::per_segment},
                {"shadow.scan", map_scan_code(), {k_sums}, MapRun::per_texel},
                {"shadow.lookup",
                 opacity_lookup_comp,
                 {k_vertices, k_segments, k_box, k_deposits, k_sums, k_fibre, k_transmittance, k_receivers},
                 MapRun::per_vertex}};
  for (MapPass& pass : map.passes) pass.per_strip = true;
  return map;
}

MapDescription description(const Settings& settings) {
  MapDescription map = settings.form == Form::compute ? describe_computed(settings) : describe_drawn(settings);
  map.passes.back().constants = {settings.vertex_weights ? 1u : 0u};  // VERTEX_WEIGHTS of ends.glsl
  return map;
}

MapWords words_of(const Map& map, const Settings& settings) {
  if (settings.form != Form::compute) return {};  // equal within the rounding of the targets only
  return {map.sums, {map.fibre.begin(), map.fibre.end()}};
}

}  // namespace

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"opacity_map", create_map<Settings, description>,
                                words_of_map<Settings, build_map, words_of>};
  return method;
}

}  // namespace cuticle::shadows::opacity_map
