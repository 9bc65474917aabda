// Deep opacity maps on the GPU: clear (fills), fit, range, histogram, layers, splat, scan, copying of the tiles that
// are kept (mark, slots, keep), packing where it is kept in bytes, lookup; the integers of the map equal the CPU's.
#include <bit>

#include "shadows/deep_opacity/deep_map.h"
#include "shadows/deep_opacity/layers.glslh"
#include "shadows/deep_opacity/tiles.glslh"
#include "shadows/deep_opacity/tiles.h"
#include "shadows/map_shadow_gpu.h"
#include "shadows/splat.glslh"

#include <deep_histogram_comp.spv.h>
#include <deep_layers_comp.spv.h>
#include <deep_lookup_comp.spv.h>
#include <deep_pack_comp.spv.h>
#include <deep_range_comp.spv.h>
#include <deep_scan_comp.spv.h>
#include <deep_splat_comp.spv.h>
#include <deep_tile_keep_comp.spv.h>
#include <deep_tile_lookup_comp.spv.h>
#include <deep_tile_mark_comp.spv.h>
#include <deep_tile_slots_comp.spv.h>

namespace cuticle::shadows::deep_opacity {
namespace {

enum Own : int {
  k_sums = k_own,
  k_ranges,
  k_ends,
  k_depths,
  k_histogram,
  k_codes,
  k_slots,
  k_list,
  k_stored_ranges,
  k_stored_sums
};

/// Shares of the layers, in room for all; then, of a map in bytes, the exponents of codes and what they are rounded by.
AfterDeposits after_deposits(const Settings& settings) {
  return [settings](double, double scale) {
    std::vector<std::uint32_t> words = layer_shares(settings);
    words.resize(k_max_layers);
    if (!settings.bytes) return words;
    for (const float exponent : code_exponents()) words.push_back(std::bit_cast<std::uint32_t>(exponent));
    const std::vector<std::uint32_t> thresholds = code_thresholds(settings.map.accumulation.k, scale);
    words.insert(words.end(), thresholds.begin(), thresholds.end());
    return words;
  };
}

std::vector<MapBuffer> buffers_of(const Settings& settings) {
  const std::uint64_t texels = std::uint64_t(settings.map.resolution) * settings.map.resolution;
  const std::uint64_t room = tile_room(settings);
  const std::uint64_t stored = settings.sparse ? room * k_tile_texels : texels;
  std::vector<MapBuffer> buffers = {{.kept = !settings.bytes && !settings.sparse, .per_strip = true},
                                    {.words = texels, .kept = !settings.sparse, .cleared = false},
                                    {.words = k_layer_words, .kept = false, .cleared = false},
                                    {.words = 2 * texels, .clear = k_no_depth, .kept = false},
                                    {.words = k_histogram_words, .kept = false}};
  if (settings.bytes || settings.sparse)
    buffers.push_back({.words = settings.bytes ? (stored * settings.layers + 3) / 4 : 1, .cleared = false});
  if (!settings.sparse) return buffers;
  buffers.push_back({.words = most_tiles(settings.map.resolution)});
  buffers.push_back({.words = room + 1, .kept = false, .cleared = false});
  buffers.push_back({.words = stored, .cleared = false});
  buffers.push_back({.words = stored * settings.layers, .kept = !settings.bytes, .cleared = false});
  return buffers;
}

/// Where the lookup finds the map, and how many texels it has room for.
struct Stored {
  int ranges = k_ranges, sums = k_sums;
  std::uint32_t texels = 0;
};
Stored stored_of(const Settings& settings) {
  if (!settings.sparse) return {k_ranges, k_sums, settings.map.resolution * settings.map.resolution};
  return {k_stored_ranges, k_stored_sums, std::uint32_t(tile_room(settings)) * k_tile_texels};
}

/// Which tiles hold hair, by the depths of all texels.
void add_slot_passes(const Settings& settings, MapDescription& map) {
  map.own = {float(tile_room(settings))};
  map.need = {.counter = k_list, .room = tile_room(settings), .items = "tiles with hair", .advice = "raise tile_share"};
  map.passes.push_back({"shadow.mark", deep_tile_mark_comp, {k_box, k_depths, k_slots}, MapRun::per_texel});
  map.passes.push_back({"shadow.slots", deep_tile_slots_comp, {k_box, k_slots, k_list}, MapRun::one_group});
}

void add_keep_pass(const Settings& settings, MapDescription& map) {
  map.passes.push_back({.name = "shadow.keep",
                        .code = deep_tile_keep_comp,
                        .buffers = {k_box, k_list, k_ranges, k_sums, k_stored_ranges, k_stored_sums},
                        .run = MapRun::given,
                        .invocations = stored_of(settings).texels,
                        .per_strip = true});
}

/// Invocations of the histogram: whole runs.
std::uint32_t counted_segments(std::uint32_t segments) {
  const std::uint32_t every = one_in(segments) * k_counted_run;
  return (segments + every - 1) / every * k_counted_run;
}

MapDescription description(const Settings& settings) {
  MapDescription map;
  map.settings = settings.map;
  map.intervals = float(k_depth_steps);
  map.layers = settings.layers;
  map.flags = (settings.spacing == Spacing::equal_opacity ? k_equal_opacity_flag : 0) |
              (settings.by_texel ? k_by_texel_flag : 0);
  map.pieces_per_step = k_pieces_per_step;
  map.after_deposits = after_deposits(settings);
  map.buffers = buffers_of(settings);
  map.passes = {{.name = "shadow.range",
                 .code = deep_range_comp,
                 .buffers = {k_vertices, k_segments, k_box, k_depths, k_depths},
                 .texels = {4}},
                {.name = "shadow.histogram",
                 .code = deep_histogram_comp,
                 .buffers = {k_vertices, k_segments, k_box, k_depths, k_histogram},
                 .run = MapRun::per_counted_segment,
                 .counted = counted_segments,
                 .texels = {3}},
                {"shadow.layers", deep_layers_comp, {k_deposits, k_histogram, k_ends}, MapRun::one_group}};
  if (settings.sparse) add_slot_passes(settings, map);
  map.passes.push_back({.name = "shadow.splat",
                        .code = deep_splat_comp,
                        .buffers = {k_vertices, k_segments, k_box, k_deposits, k_depths, k_ends, k_sums},
                        .texels = {3, 4, 5},
                        .per_strip = true});
  map.passes.push_back({.name = "shadow.scan",
                        .code = deep_scan_comp,
                        .buffers = {k_depths, k_ranges, k_sums, k_box},
                        .run = MapRun::per_texel,
                        .per_strip = true});
  if (settings.sparse) add_keep_pass(settings, map);
  const Stored stored = stored_of(settings);
  if (settings.bytes)
    map.passes.push_back({.name = "shadow.pack",
                          .code = deep_pack_comp,
                          .buffers = {k_deposits, stored.sums, k_codes, k_box},
                          .run = MapRun::given,
                          .invocations = stored.texels,
                          .per_strip = !settings.sparse});
  MapPass lookup{"shadow.lookup",
                 deep_lookup_comp,
                 {k_vertices, k_segments, k_box, stored.ranges, k_ends, settings.bytes ? k_codes : stored.sums,
                  k_deposits, k_transmittance},
                 MapRun::per_vertex};
  lookup.texels = {3, 4, 5, 6};
  lookup.constants = {settings.bytes ? 1u : 0u};
  lookup.per_strip = !settings.sparse && !settings.bytes;
  if (settings.sparse) {
    lookup.code = deep_tile_lookup_comp;
    lookup.buffers.push_back(k_slots);
  }
  lookup.buffers.push_back(k_receivers);
  map.passes.push_back(std::move(lookup));
  return map;
}

/// The words before packing too.
Map build_both(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  Settings words = settings;
  words.bytes = false;
  Map map = build_map(groom, alpha, axes, words);
  if (settings.bytes) map.codes = pack(map, settings.map.accumulation.k);
  return map;
}

MapWords words_of(const Map& map, const Settings& settings) {
  MapWords words(k_stored_sums + 1);  // depths and histogram are not kept here
  words[k_ends].assign(map.ends.end, map.ends.end + k_max_layers);
  words[k_ends].push_back(map.fibre);
  words[std::size_t(stored_of(settings).sums)] = map.sums;
  words[std::size_t(stored_of(settings).ranges)] = map.ranges;
  words[k_codes] = map.codes;
  words[k_slots] = map.slots;
  return words;
}

}  // namespace

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"deep_opacity", create_map<Settings, description>,
                                words_of_map<Settings, build_both, words_of>};
  return method;
}

}  // namespace cuticle::shadows::deep_opacity
