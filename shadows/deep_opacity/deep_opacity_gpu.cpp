// Deep opacity maps on the GPU: clear (fills), fit, range, histogram, layers, splat, scan, packing where it is kept
// in bytes, lookup; the integers of the map equal the CPU's.
#include <bit>

#include <cuticle/shadows/deep_opacity/deep_map.h>
#include <cuticle/shadows/map_shadow_gpu.h>
#include <cuticle/shadows/splat.glslh>

#include <deep_histogram_comp.spv.h>
#include <deep_layers_comp.spv.h>
#include <deep_lookup_comp.spv.h>
#include <deep_pack_comp.spv.h>
#include <deep_range_comp.spv.h>
#include <deep_scan_comp.spv.h>
#include <deep_splat_comp.spv.h>

namespace cuticle::shadows::deep_opacity {
namespace {

constexpr std::uint32_t k_equal_opacity_flag = 2;  // k_equal_opacity of deep_layers.comp
constexpr std::uint32_t k_bytes_flag = 4;          // k_bytes of deep_lookup.comp
enum Own : int { k_sums = k_own, k_ranges, k_ends, k_depths, k_histogram, k_codes };

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
  std::vector<MapBuffer> buffers = {{.words = numbers, .kept = !settings.bytes},
                                    {.words = texels, .cleared = false},
                                    {.words = k_most_layers + 1, .kept = false, .cleared = false},
                                    {.words = 2 * texels, .clear = k_no_depth, .kept = false},
                                    {.words = k_histogram_words, .kept = false}};
  if (settings.bytes) buffers.push_back({.words = (numbers + 3) / 4, .cleared = false});
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
      {"shadow.range", deep_range_comp, {k_vertices, k_segments, k_box, k_depths}},
      {"shadow.histogram", deep_histogram_comp, {k_vertices, k_segments, k_box, k_depths, k_histogram}},
      {"shadow.layers", deep_layers_comp, {k_deposits, k_histogram, k_ends}, MapRun::one_group},
      {"shadow.splat", deep_splat_comp, {k_vertices, k_segments, k_box, k_deposits, k_depths, k_ends, k_sums}},
      {"shadow.scan", deep_scan_comp, {k_depths, k_ranges, k_sums}, MapRun::per_texel}};
  if (settings.bytes)
    map.passes.push_back({"shadow.pack", deep_pack_comp, {k_deposits, k_sums, k_codes}, MapRun::per_texel});
  map.passes.push_back(
      {"shadow.lookup",
       deep_lookup_comp,
       {k_vertices, k_box, k_ranges, k_ends, settings.bytes ? k_codes : k_sums, k_deposits, k_transmittance},
       MapRun::per_vertex});
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
  MapWords words = {map.sums, map.ranges, {map.ends.end, map.ends.end + k_most_layers}};
  words.back().push_back(map.fibre);
  if (!settings.bytes) return words;
  words.resize(k_codes);  // depths and histogram are not kept here
  words.push_back(map.codes);
  return words;
}

}  // namespace

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"deep_opacity", create_map<settings_from, describe>,
                                words_of_map<settings_from, build_both, words_of>};
  return method;
}

}  // namespace cuticle::shadows::deep_opacity
