// The registered method: parameters, demands, and the CPU evaluation.
#include <cuticle/shadows/deep_opacity/deep_map.h>
#include <cuticle/shadows/detail/map_method.h>

namespace cuticle::shadows::deep_opacity {
namespace {

using registry::ParameterType;
constexpr std::string_view k_spacings[] = {"equal_opacity", "geometric", "equal"};
constexpr std::string_view k_storages[] = {"words", "bytes"};
constexpr registry::Parameter k_parameters[] = {
    {"layers", ParameterType::integer, "1", 1, k_most_layers, "4", {}, "layers behind the nearest fibre of a texel"},
    k_resolution,
    k_optical_k,
    k_filter_texels,
    k_filter_radius,
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
     "words: 32 bits a layer; bytes: 8, and 16 for the nearest depth (CPU only)"},
};
constexpr std::string_view k_demands[] = {"light", "shadow_method"};
constexpr std::string_view k_systems[] = {"G3"};
constexpr registry::StudyCase k_cases[] = {{"1 layer", "layers=1"}, {"4 layers", "layers=4"}, {"8 layers", "layers=8"}};

/// What storage=bytes keeps: the map without its 32-bit numbers, and the bytes.
struct Kept {
  MapView view;
  Map map;
  ByteMap bytes;
};
Kept build_kept(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  Kept kept;
  kept.map = build_map(groom, alpha, axes, settings);
  kept.view = kept.map.view;
  kept.bytes = in_bytes(kept.map, settings.map.accumulation.k);
  kept.map.sums = {};
  kept.map.nearest = {};
  return kept;
}
std::vector<float> look_up_kept(const Kept& kept, const Settings& settings, float filter,
                                std::span<const glm::vec3> points) {
  return look_up(kept.map, kept.bytes, settings, filter, points);
}
std::vector<float> look_up_words(const Map& map, const Settings& settings, float filter,
                                 std::span<const glm::vec3> points) {
  return look_up(map, settings, filter, points);
}

Result<Transmittance> evaluate(const Casters& casters, const Receivers& receivers,
                               const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(const Settings settings, settings_from(values));
  if (settings.bytes)
    return evaluate_by_map(
        "deep_opacity", casters, receivers, settings, build_kept, look_up_kept,
        [](const Kept& kept) { return kept.bytes.visibility.size() + 2 * kept.bytes.nearest.size(); });
  return evaluate_by_map("deep_opacity", casters, receivers, settings, build_map, look_up_words,
                         [](const Map& map) { return 4 * (map.sums.size() + map.nearest.size()); });
}

/// Fit, nearest, histogram, layers, splat, scan, lookup; the clearing is a fill.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape& shape) {
  return 7 * shape.lights;
}

}  // namespace

const Method& entry() {
  static const Method method{{registry::EntryKind::method, "deep_opacity",
                              "opacity in layers that follow the hair's nearest surface (deep opacity map)",
                              "Yuksel and Keyser 2008, Deep Opacity Maps", k_parameters, k_demands,
                              registry::Stage::shadow, k_systems, k_cases, dispatches, 0},
                             evaluate};
  return method;
}

}  // namespace cuticle::shadows::deep_opacity
