#pragma once
// A method of maps on the device, described by the buffers of its map and the passes that fill it and look it up.
#include <initializer_list>

#include "shadows/light_frame.h"
#include "shadows/map_gpu.h"
#include "shadows/map_series.h"
#include "shadows/map_settings.h"
#include "shadows/method_gpu.h"

namespace cuticle::shadows {

/// What a pass binds: what every method has, by these numbers, or the method's own buffers, from 0. Shaders read
/// vertices and segments as texels (samplerBuffer, usamplerBuffer).
enum MapBinding : int { k_receivers = -6, k_vertices, k_segments, k_box, k_deposits, k_transmittance, k_own = 0 };

/// One of the method's buffers of 32-bit words.
struct MapBuffer {
  std::uint64_t words = 0;
  std::uint32_t clear = 0;  ///< every word, at the start of each frame
  bool kept = true;         ///< part of the map that is looked up; else it only serves to fill it
  bool cleared = true;      ///< else only what is written is read
  bool per_strip = false;   ///< `words` are MapDescription::layers a texel of the map, of which one strip is held
  bool cleared_per_strip = false;  ///< of another size, but cleared for each strip
};
/// Of a map whose need is known once it is filled: the last word of one of the buffers counts the items that it would
/// hold, of its fullest strip. Where `grown` names none, settle() only says what was left out.
struct MapNeed {
  int counter = -1;              ///< the buffer; -1: the need is known before
  std::uint64_t room = 0;        ///< items that there is room for
  std::uint64_t most_room = 0;   ///< that settle() may make room for
  std::vector<int> grown = {};   ///< buffers that hold them; passes find the room in push.layers
  std::size_t counting = 0;      ///< the first so many passes count the items
  std::uint64_t item_bytes = 0;  ///< in each
  std::string_view items, advice;
};
enum class MapRun {
  per_segment,
  per_counted_segment,
  per_texel,
  per_row,
  per_vertex,
  per_vertices,  ///< k_vertices_each of them
  one_group,
  given
};
inline constexpr std::uint32_t k_vertices_each = 16;  // of map_fit.comp
struct MapPass {
  std::string_view name;  ///< "shadow.splat"
  std::span<const std::uint32_t> code;
  std::vector<int> buffers;  ///< MapBinding, in the order of the shader's bindings
  MapRun run = MapRun::per_segment;
  bool reads_targets = false;                                  ///< the targets follow the buffers as textures
  std::uint32_t invocations = 0;                               ///< of MapRun::given
  std::uint32_t (*counted)(std::uint32_t segments) = nullptr;  ///< of MapRun::per_counted_segment
  std::vector<std::uint32_t> texels = {};     ///< further bindings that are read as texels (usamplerBuffer)
  bool per_strip = false;                     ///< run for each strip of rows, with those beside it in the list
  std::vector<std::uint32_t> constants = {};  ///< values of constant_id 0, 1, 2, ...
};
/// The graphics form: two triangles a segment, whose fragments are added into square targets, cleared to 0 before.
struct MapDrawing {
  std::span<const std::uint32_t> vertex_code, fragment_code;  ///< both bound to vertices, segments, box, deposits
  std::uint32_t targets = 0;
  gpu::TextureFormat format = gpu::TextureFormat::rgba8;
};
struct MapDescription {
  MapSettings settings;
  float intervals = 1;           ///< depth steps of the view
  std::uint32_t layers = 1;      ///< numbers a texel
  std::uint32_t flags = 0;       ///< the method's own, beside k_poisson_flag
  float pieces_per_step = 1;     ///< a steep segment is cut so that its pieces are at most 1 / this deep
  std::vector<float> own;        ///< at most 2 numbers for its shaders
  AfterDeposits after_deposits;  ///< null: nothing follows the table of deposits
  bool signed_sums = false;      ///< half of the sums' range is left to the sign
  bool in_world = false;         ///< the box is that of the world's axes, not of the light's
  std::vector<MapBuffer> buffers;
  MapNeed need;
  MapDrawing drawing;           ///< "shadow.draw", after "shadow.fit", where it has targets
  std::vector<MapPass> passes;  ///< after "shadow.clear" (fills), "shadow.fit" and the drawing
};

/// The passes of a map. All records of one submission must share alpha and the number of segments, because the table of
/// deposits is uploaded when they change. The light's view is fitted to the vertices as they are on the device; a
/// filter in metres is cut off at 64 texels. Where nothing casts, the transmittance is filled with 1. Error:
/// out_of_memory where the map passes the device's limits. A buffer that is held per strip may pass them: the map then
/// comes in as few strips of rows as keep them, each filled and looked up before the next, with equal results.
Result<std::unique_ptr<GpuShadow>> make_map_shadow(std::shared_ptr<gpu::Device> device, MapDescription description);

/// A map of functions of depth (map_series.h), with `lookup` bound to vertices, segments, box, deposits with the
/// weights behind them, sums, the mean fibre, transmittance.
MapDescription describe_series(const MapSettings& settings, std::uint32_t functions, const std::vector<float>& weights,
                               std::span<const std::uint32_t> lookup);

/// Words of such a map for GpuMethod::cpu_map.
inline constexpr auto k_series_words = [](const SeriesMap& map) {
  return MapWords{map.sums, {map.fibre.begin(), map.fibre.end()}};
};

/// GpuMethod::create of a method, from its Settings and description(settings), which may be a Result.
template <class Settings, auto description>
Result<std::unique_ptr<GpuShadow>> create_map(std::shared_ptr<gpu::Device> device,
                                              const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(const Settings settings, settings_from<Settings>(values));
  CUTICLE_ASSIGN(MapDescription map, Result(description(settings)));
  return make_map_shadow(std::move(device), std::move(map));
}

/// GpuMethod::cpu_map of a method, from its Settings, build(groom, alpha, axes, settings) and
/// words_of(map, settings), which are the map's sums unless given.
inline constexpr auto k_sums_of = [](const auto& map) { return MapWords{map.sums}; };
template <class Settings, auto build, auto words_of = k_sums_of>
Result<MapWords> words_of_map(const Casters& casters, const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(const Settings settings, settings_from<Settings>(values));
  CUTICLE_ASSIGN(const LightAxes axes, axes_of(casters));
  CUTICLE_ASSIGN(const auto map, Result(build(*casters.groom, casters.alpha, axes, settings)));
  if constexpr (requires { words_of(map); })
    return words_of(map);
  else
    return words_of(map, settings);
}

}  // namespace cuticle::shadows
