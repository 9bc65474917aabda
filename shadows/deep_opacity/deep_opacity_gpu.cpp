// Deep opacity maps on the GPU: clear (fills), fit, nearest, histogram, layers, splat, scan, packing where it is kept
// in bytes, lookup; the integers of the map equal the CPU's.
#include <bit>

#include <cuticle/shadows/deep_opacity/deep_map.h>
#include <cuticle/shadows/map_shadow_gpu.h>
#include <cuticle/shadows/splat.glslh>

#include <deep_histogram_comp.spv.h>
#include <deep_layers_comp.spv.h>
#include <deep_lookup_comp.spv.h>
#include <deep_pack_comp.spv.h>
#include <deep_splat_comp.spv.h>

namespace cuticle::shadows::deep_opacity {
namespace {

constexpr std::uint32_t k_equal_opacity_flag = 2;  // k_equal_opacity of deep_layers.comp
constexpr std::uint32_t k_bytes_flag = 4;          // k_bytes of deep_lookup.comp
enum Own : int { k_sums = k_own, k_nearest, k_ends, k_histogram, k_codes, k_packed_nearest };

/// Shares of the layers, in room for all; then, of a map in bytes, the exponents of codes and what they are rounded by.
AfterDeposits after_deposits(const Settings& settings) {
  return [settings](double, double scale) {
    std::vector<std::uint32_t> words = layer_shares(settings);
    words.resize(k_most_layers);
    if (!settings.bytes) return words;
    for (const float exponent : code_exponents()) words.push_back(std::bit_cast<std::uint32_t>(exponent));
    const std::vector<std::uint32_t> thresholds = code_thresholds(settings.map.accumulation.k, scale);
    words.insert(words.end(), thresholds.begin(), thresholds.end());
    return words;
  };
}

std::vector<MapBuffer> buffers_of(const Settings& settings) {
  const std::uint64_t texels = std::uint64_t(settings.map.resolution) * settings.map.resolution;
  const std::uint64_t numbers = texels * settings.layers;
  std::vector<MapBuffer> buffers = {{numbers, 0, !settings.bytes},
                                    {texels, k_no_depth, !settings.bytes},
                                    {k_most_layers, 0, false},
                                    {k_depth_steps, 0, false}};
  if (settings.bytes) {
    buffers.push_back({(numbers + 3) / 4});
    buffers.push_back({(texels + 1) / 2});
  }
  return buffers;
}

MapDescription describe(const Settings& settings) {
  MapDescription map;
  map.settings = settings.map;
  map.intervals = float(k_depth_steps);
  map.layers = settings.layers;
  map.flags =
      (settings.spacing == Spacing::equal_opacity ? k_equal_opacity_flag : 0) | (settings.bytes ? k_bytes_flag : 0);
  map.pieces_per_step = k_pieces_per_step;
  map.after_deposits = after_deposits(settings);
  map.buffers = buffers_of(settings);
  map.passes = {
      {"shadow.nearest", map_nearest_code(), {k_vertices, k_segments, k_box, k_nearest}},
      {"shadow.histogram", deep_histogram_comp, {k_vertices, k_segments, k_box, k_nearest, k_histogram}},
      {"shadow.layers", deep_layers_comp, {k_deposits, k_histogram, k_ends}, MapRun::one_group},
      {"shadow.splat", deep_splat_comp, {k_vertices, k_segments, k_box, k_deposits, k_nearest, k_ends, k_sums}},
      {"shadow.scan", map_scan_code(), {k_sums}, MapRun::per_texel}};
  if (settings.bytes)
    map.passes.push_back(
        {"shadow.pack", deep_pack_comp, {k_deposits, k_nearest, k_sums, k_packed_nearest, k_codes}, MapRun::per_texel});
  const int nearest = settings.bytes ? k_packed_nearest : k_nearest, sums = settings.bytes ? k_codes : k_sums;
  map.passes.push_back({"shadow.lookup",
                        deep_lookup_comp,
                        {k_vertices, k_box, nearest, k_ends, sums, k_deposits, k_transmittance},
                        MapRun::per_vertex});
  return map;
}

/// The words before packing too.
Map build_both(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  Settings words = settings;
  words.bytes = false;
  Map map = build_map(groom, alpha, axes, words);
  if (settings.bytes) map.packed = pack(map, settings.map.accumulation.k);
  return map;
}

MapWords words_of(const Map& map, const Settings& settings) {
  MapWords words = {map.sums, map.nearest, {map.ends.end, map.ends.end + map.ends.count}};
  if (!settings.bytes) return words;
  words.emplace_back();  // the histogram, which is not kept here
  words.push_back(map.packed.codes);
  words.push_back(map.packed.nearest);
  return words;
}

}  // namespace

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"deep_opacity", create_map<settings_from, describe>,
                                words_of_map<settings_from, build_both, words_of>};
  return method;
}

}  // namespace cuticle::shadows::deep_opacity
