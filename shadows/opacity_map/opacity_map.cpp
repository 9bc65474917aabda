// The registered method: parameters, demands, and the CPU evaluation.
#include <chrono>

#include <cuticle/shadows/method.h>
#include <cuticle/shadows/opacity_map/map.h>

namespace cuticle::shadows::opacity_map {
namespace {

using registry::ParameterType;
constexpr std::string_view k_spacings[] = {"last_plane", "printed"};
constexpr registry::Parameter k_parameters[] = {
    {"slices",
     ParameterType::integer,
     "1",
     2,
     256,
     "16",
     {},
     "evenly spaced planes; the first holds nothing and is not stored"},
    k_resolution,
    k_optical_k,
    k_filter_texels,
    k_filter_radius,
    k_accumulate,
    {"spacing", ParameterType::choice, "1", 0, 0, "last_plane", k_spacings,
     "last_plane: range / (slices - 1); printed: range / slices, which stops short of the last plane"},
};
constexpr std::string_view k_demands[] = {"light", "shadow_method"};
constexpr std::string_view k_systems[] = {"N17"};
constexpr registry::StudyCase k_cases[] = {
    {"4 slices", "slices=4"}, {"16 slices", "slices=16"}, {"64 slices", "slices=64"}};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Result<Transmittance> evaluate(const Casters& casters, const Receivers& receivers,
                               const registry::ParameterValues& values) {
  CUTICLE_TRY(check(casters, receivers));
  CUTICLE_ASSIGN(const Settings settings, settings_from(values));
  CUTICLE_ASSIGN(const glm::dvec3 to_light, unit_to_light(casters.to_light));
  Transmittance result;
  const auto start = std::chrono::steady_clock::now();
  const Map map = build_map(*casters.groom, casters.alpha, light_axes(to_light), settings);
  CUTICLE_ASSIGN(const float filter, filter_in_texels("opacity_map", settings.map, double(map.view.scale.x)));
  result.cost.build_ms = milliseconds_since(start);
  const auto built = std::chrono::steady_clock::now();
  result.values = look_up(map, settings, filter, receivers.points);
  result.cost.lookup_ms = milliseconds_since(built);
  result.cost.bytes = map.sums.size() * sizeof(map.sums[0]);
  result.cost.device = cpu_device_name();
  return result;
}

/// Fit, splat, scan, lookup; the clearing is a fill.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape& shape) {
  return 4 * shape.lights;
}

}  // namespace

const Method& entry() {
  static const Method method{{registry::EntryKind::method, "opacity_map",
                              "opacity at evenly spaced slices of the light's view (opacity shadow map)",
                              "Kim and Neumann 2001; Nguyen and Donnelly, GPU Gems 2, chapter 23 (the Nalu demo)",
                              k_parameters, k_demands, registry::Stage::shadow, k_systems, k_cases, dispatches, 0},
                             evaluate};
  return method;
}

}  // namespace cuticle::shadows::opacity_map
