// The registered method: parameters, demands, and the CPU evaluation.
#include "shadows/deep_opacity/deep_map.h"
#include "shadows/detail/map_method.h"

namespace cuticle::shadows::deep_opacity {
namespace {

using registry::ParameterType;
constexpr std::string_view k_spacings[] = {"equal_opacity", "geometric", "equal"};
constexpr std::string_view k_storages[] = {"words", "bytes"};
constexpr std::string_view k_tiles[] = {"all", "sparse"};
constexpr registry::Parameter k_parameters[] = {
    {"layers", ParameterType::integer, "1", 1, k_most_layers, "4", {}, "layers behind the nearest fibre of a texel"},
    k_resolution,
    k_optical_k,
    k_filter_texels,
    k_filter_radius,
    k_depth_offset,
    k_accumulate,
    {"spacing", ParameterType::choice, "1", 0, 0, "equal_opacity", k_spacings,
     "equal_opacity: layers of equal projected length of hair; geometric: growing by one ratio; equal: equally deep"},
    {"first_layer",
     ParameterType::real,
     "1",
     0,
     1,
     "0",
     {},
     "geometric: the first layer's share of the depth; 0: 1/32 up to 4 layers, 1/128 beyond"},
    {"storage", ParameterType::choice, "1", 0, 0, "words", k_storages,
     "words: 32 bits a layer; bytes: 8, and 32 for the depths"},
    {"tiles", ParameterType::choice, "1", 0, 0, "all", k_tiles,
     "sparse: only tiles of 4 x 4 texels that hold hair are stored, and a number for every tile"},
    {"tile_share",
     ParameterType::real,
     "1",
     0.001,
     1,
     "1",
     {},
     "sparse: room, as a share of all tiles; those that find none are left out, counted as clamped"},
};
constexpr std::string_view k_systems[] = {"G3"};
constexpr registry::StudyCase k_cases[] = {{"1 layer", "layers=1"},
                                           {"4 layers", "layers=4"},
                                           {"8 layers", "layers=8"},
                                           {"sparse tiles", "layers=7,tiles=sparse,storage=bytes,tile_share=0.9"}};

/// Fit, range, histogram, layers, splat, scan, lookup; before it three for sparse tiles, and packing. The clearing is a
/// fill.
std::uint32_t dispatches(const registry::ParameterValues& values, const registry::FrameShape& shape) {
  const std::uint32_t tiles = values.choice("tiles") == "sparse" ? 3 : 0;
  return (7 + tiles + (values.choice("storage") == "bytes" ? 1 : 0)) * shape.lights;
}

/// Bytes hold T.
bool is_proportional(const registry::ParameterValues& values) {
  return is_poisson(values) && values.choice("storage") != "bytes";
}

}  // namespace

const Method& entry() {
  static const Method method = map_method<settings_from, build_map, look_up>(
      {.name = "deep_opacity",
       .summary = "opacity in layers that follow the hair's nearest surface (deep opacity map)",
       .source = "Yuksel and Keyser 2008, Deep Opacity Maps",
       .parameters = k_parameters,
       .systems = k_systems,
       .study_cases = k_cases,
       .dispatches = dispatches},
      is_proportional);
  return method;
}

}  // namespace cuticle::shadows::deep_opacity
