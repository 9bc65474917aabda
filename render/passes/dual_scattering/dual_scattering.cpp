#include "render/passes/dual_scattering/dual_scattering.h"

#include "render/inputs.h"
#include "render/passes/bake_tables/bake_tables.h"
#include "render/shading.h"

namespace cuticle::render::dual_scattering {

namespace {

constexpr std::string_view k_demands[] = {"light", "dual_scattering"};
constexpr Use k_uses[] = {reads<FibreMaterial>(), reads<FibreOpacity>(),           may_read<RestStrands>(),
                          may_read<Surfaces>(),   may_read<bake_tables::Tables>(), writes<Terms>()};
constexpr std::string_view k_after[] = {"bake_tables"};
constexpr std::string_view k_systems[] = {"F11"};
constexpr std::string_view k_corrections[] = {"none", "path_tracing"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.forward_density, "forward_density", "1", 0, 10,
          "the paper's d_f: a factor on light that other fibres send on");
  members(p.backward_density, "backward_density", "1", 0, 10,
          "the paper's d_b: a factor on light that fibres around a point send back");
  members(p.direction_spread, "direction_spread", "rad", 0, 2,
          "standard deviation of the inclinations of fibres about a point, by which each scattering spreads more "
          "widely; 0: parallel fibres, as the paper has them");
  members(
      p.corrections, "corrections", k_corrections,
      "path_tracing: further factors by albedo, optical depth and thickness of the hair, and on a head by the angle "
      "between light and eye, fitted to path tracing");
}

const Pass& entry() {
  static const Pass pass =
      with_uses(shading({.name = "dual_scattering",
                         .summary = "averages of the fibre, from which light that was scattered many times is "
                                    "added, in place of lines.ambient",
                         .source = "Zinke, Yuksel, Weber and Keyser 2008, Dual scattering approximation",
                         .parameters = registry::table_of<Parameters>(),
                         .demands = k_demands,
                         .systems = k_systems,
                         .dispatches = always<0>,
                         .after = k_after}),
                k_uses);
  return pass;
}

}  // namespace cuticle::render::dual_scattering
