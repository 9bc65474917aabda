// The registered method: parameters, demands, and the CPU evaluation.
#include "shadows/deep_opacity/deep_map.h"
#include "shadows/detail/map_method.h"

namespace cuticle::shadows::deep_opacity {
namespace {

constexpr std::string_view k_spacings[] = {"equal_opacity", "geometric", "equal"};
constexpr std::string_view k_ranges[] = {"map", "texel"};
constexpr std::string_view k_storages[] = {"words", "bytes"};
constexpr std::string_view k_tiles[] = {"all", "sparse"};
constexpr std::string_view k_systems[] = {"G3"};
constexpr registry::StudyCase k_cases[] = {{"1 layer", "layers=1"},
                                           {"4 layers", "layers=4"},
                                           {"8 layers", "layers=8"},
                                           {"8 layers of one range", "layers=8,layer_range=map"},
                                           {"sparse tiles", "layers=7,tiles=sparse,storage=bytes,tile_share=0.9"}};

/// Fit, range, histogram, layers, splat, scan, lookup; before it three for sparse tiles, and packing. The clearing is a
/// fill.
std::uint32_t dispatches(const registry::ParameterValues& values, const registry::FrameShape& shape) {
  const auto settings = registry::from_values<Settings>(values);
  return (7 + (settings.sparse ? 3 : 0) + (settings.bytes ? 1 : 0)) * shape.lights;
}

/// Bytes hold T.
bool is_proportional(const registry::ParameterValues& values) {
  const auto settings = registry::from_values<Settings>(values);
  return settings.map.accumulation.poisson && !settings.bytes;
}

}  // namespace

void describe(registry::Members& members, Settings& settings) {
  members(settings.layers, "layers", 1, k_max_layers, "layers behind the nearest fibre of a texel");
  describe(members, settings.map);
  members(settings.spacing, "spacing", k_spacings,
          "equal_opacity: by projected length of hair, the same for each layer (layer_range=texel: less for those "
          "nearer to the light); geometric: growing by one ratio; equal: equally deep");
  members(
      settings.by_texel, "layer_range", k_ranges,
      "texel: layers divide the hair of each texel, from its nearest fibre to its farthest; map: they are equally deep "
      "in all texels, as published");
  members(settings.first_layer, "first_layer", "1", 0, 1,
          "geometric: the first layer's share of the depth; 0: 1/32 up to 4 layers, 1/128 beyond");
  members(settings.bytes, "storage", k_storages, "words: 32 bits a layer; bytes: 8, and 32 for the depths");
  members(settings.sparse, "tiles", k_tiles,
          "sparse: only tiles of 4 x 4 texels that hold hair are stored, and a number for every tile");
  members(settings.tile_share, "tile_share", "1", 0.001, 1,
          "sparse: room, as a share of all tiles; those that find none are left out, counted as clamped");
}

const Method& entry() {
  static const Method method = map_method<Settings, build_map, look_up>(
      {.name = "deep_opacity",
       .summary = "opacity in layers that follow the hair's nearest surface (deep opacity map)",
       .source = "Yuksel and Keyser 2008, Deep Opacity Maps",
       .systems = k_systems,
       .study_cases = k_cases,
       .dispatches = dispatches},
      is_proportional);
  return method;
}

}  // namespace cuticle::shadows::deep_opacity
