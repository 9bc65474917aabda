#include "render/passes/dual_scattering/dual_scattering.h"

#include "render/shading.h"

namespace cuticle::render::dual_scattering {

namespace {

constexpr std::string_view k_demands[] = {"light", "output_color", "dual_scattering"};
constexpr std::string_view k_after[] = {"bake_tables"};
constexpr std::string_view k_systems[] = {"F11"};
constexpr registry::Parameter k_parameters[] = {
    {.name = "forward_density",
     .minimum = 0,
     .maximum = 1,
     .default_text = "1",
     .summary = "the paper's d_f: how much of what other fibres send on arrives"},
    {.name = "backward_density",
     .minimum = 0,
     .maximum = 1,
     .default_text = "1",
     .summary = "the paper's d_b: how much of what fibres around a point send back leaves"},
    {.name = "direction_spread",
     .unit = "rad",
     .minimum = 0,
     .maximum = 2,
     .default_text = "0.4",
     .summary = "standard deviation of the inclinations of fibres about a point, by which each scattering spreads more "
                "widely; 0: parallel fibres, as the paper has them"},
};

}  // namespace

const Pass& entry() {
  static const Pass pass = shading({.name = "dual_scattering",
                                    .summary = "averages of the fibre, from which light that was scattered many times is "
                                               "added, in place of lines.ambient",
                                    .source = "Zinke, Yuksel, Weber and Keyser 2008, Dual scattering approximation",
                                    .parameters = k_parameters,
                                    .demands = k_demands,
                                    .systems = k_systems,
                                    .dispatches = always<0>,
                                    .after = k_after});
  return pass;
}

}  // namespace cuticle::render::dual_scattering
