// The registered method: parameters, demands, and the CPU evaluation.
#include "shadows/detail/map_method.h"
#include "shadows/opacity_map/map.h"

namespace cuticle::shadows::opacity_map {
namespace {

constexpr std::string_view k_spacings[] = {"last_plane", "printed"};
constexpr std::string_view k_forms[] = {"compute", "graphics_8bit", "graphics_half"};
constexpr std::string_view k_weights[] = {"per_fragment", "per_vertex"};
constexpr std::string_view k_between[] = {"even", "random"};
constexpr std::string_view k_systems[] = {"N17", "N18", "N19", "N20"};
constexpr registry::StudyCase k_cases[] = {
    {"4 slices", "slices=4"}, {"16 slices", "slices=16"}, {"64 slices", "slices=64"}};

/// Fit, splat, scan, lookup; drawn: fit and lookup. The clearing is a fill.
std::uint32_t dispatches(const registry::ParameterValues& values, const registry::FrameShape& shape) {
  return (registry::from_values<Settings>(values).form == Form::compute ? 4 : 2) * shape.lights;
}

/// Drawn targets are cut off or rounded, more or less by alpha.
bool is_proportional(const registry::ParameterValues& values) {
  return is_poisson<Settings>(values) && registry::from_values<Settings>(values).form == Form::compute;
}

}  // namespace

void describe(registry::Members& members, Settings& settings) {
  members(settings.slices, "slices", 2, 256, "evenly spaced planes; the first holds nothing and is not stored");
  describe(members, settings.map);
  members(settings.printed_spacing, "spacing", k_spacings,
          "last_plane: range / (slices - 1); printed: range / slices, which stops short of the last plane");
  members(settings.form, "form", k_forms,
          "compute: 32-bit integers; graphics: four blended four-channel targets of 8 bits or half floats, at most 17 "
          "slices");
  members(settings.vertex_weights, "weights", k_weights,
          "tent weights of points between two vertices: their own (per_fragment), or interpolated from the vertices'");
  members(
      settings.scattered, "between", k_between,
      "fibres between two slices: at random depths (random), or spread evenly as in the source (even), as they always "
      "are with accumulate=poisson, a graphics form or weights=per_vertex");
}

const Method& entry() {
  static const Method method = map_method<Settings, build_map, look_up>(
      {.name = "opacity_map",
       .summary = "opacity at evenly spaced slices of the light's view (opacity shadow map)",
       .source = "Kim and Neumann 2001; Nguyen and Donnelly, GPU Gems 2, chapter 23 (the Nalu demo)",
       .systems = k_systems,
       .study_cases = k_cases,
       .dispatches = dispatches},
      is_proportional);
  return method;
}

}  // namespace cuticle::shadows::opacity_map
