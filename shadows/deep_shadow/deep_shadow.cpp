// The registered method: parameters, demands, and the CPU evaluation.
#include <cuticle/shadows/deep_shadow/visibility.h>
#include <cuticle/shadows/detail/map_method.h>

namespace cuticle::shadows::deep_shadow {
namespace {

using registry::ParameterType;
constexpr registry::Parameter k_parameters[] = {
    {"layers", ParameterType::integer, "1", 1, k_most_pieces, "256", {}, "most straight pieces of a texel's function"},
    {"error_bound",
     ParameterType::real,
     "1",
     0,
     0.5,
     "0.02",
     {},
     "largest error of a texel's visibility, where the pieces suffice"},
    k_resolution,
    k_optical_k,
    k_filter_texels,
    k_filter_radius,
    k_accumulate,
};
constexpr std::string_view k_demands[] = {"light", "shadow_method"};
constexpr registry::StudyCase k_cases[] = {{"bound 0.1", "error_bound=0.1"}, {"bound 0.02", "error_bound=0.02"}};

struct Settings {
  MapSettings map;
  double error_bound = 0.02;
  std::size_t layers = k_most_pieces;
};
struct Map {
  MapView view;
  PackedFunctions functions;
};

Result<Map> build(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  CUTICLE_ASSIGN(const FragmentLists lists, sort_fragments("deep_shadow", groom, alpha, axes, settings.map));
  const float per_unit = float(-settings.map.accumulation.k / lists.scale);
  return Map{lists.view, pack(lists, per_unit, settings.error_bound, settings.layers)};
}

std::vector<float> look_up(const Map& map, const Settings& settings, float filter, std::span<const glm::vec3> points) {
  std::vector<float> values(points.size());
  const MapFilter around{filter, settings.map.accumulation.poisson};
  const auto exponent = [&](std::size_t texel, float z) {
    return std::log(std::max(0x1p-17f, visibility_at(map.functions.of(texel), z)));
  };
  for_each_index(points.size(), [&](std::size_t i) {
    values[i] = transmittance_at(map.view, around, k_behind_lists, points[i], exponent);
  });
  return values;
}

Result<Transmittance> evaluate(const Casters& casters, const Receivers& receivers,
                               const registry::ParameterValues& values) {
  const Settings settings{map_settings(values), values.real("error_bound"), std::size_t(values.integer("layers"))};
  return evaluate_by_map("deep_shadow", casters, receivers, settings, build, look_up,
                         [](const Map& map) { return map.functions.bytes(); });
}

}  // namespace

const Method& entry() {
  static const Method method{{registry::EntryKind::method,
                              "deep_shadow",
                              "a visibility function per texel, compressed within an error bound (deep shadow map)",
                              "Lokovic and Veach 2000, Deep Shadow Maps, section 3",
                              k_parameters,
                              k_demands,
                              registry::Stage::shadow,
                              {},
                              k_cases},
                             evaluate};
  return method;
}

}  // namespace cuticle::shadows::deep_shadow
