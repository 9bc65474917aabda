#include "render/passes/reference/reference_entry.h"

#include <vector>

#include "render/frame.h"
#include "shadows/method.h"
#include "strands/curve_kind.h"

namespace cuticle::render::reference {

namespace {

constexpr std::string_view k_demands[] = {"strands", "drawn_by_reference"};
constexpr Use k_uses[] = {reads<DrawnHair>(), may_read<HeadVertices>(), writes<Output>()};
constexpr std::string_view k_fields[] = {"near", "far"};

/// "traced", then every shadow method.
std::span<const std::string_view> shadow_choices() {
  static const std::vector<std::string_view> choices = [] {
    std::vector<std::string_view> names = {"traced"};
    for (const shadows::Method* method : shadows::methods()) names.push_back(method->entry.name);
    return names;
  }();
  return choices;
}

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.samples, "samples", 1, 1e6, "paths of a pixel, at most");
  members(p.bounces, "bounces", 0, 1e6, "scatterings of a path, at most; 1: direct light alone; 0: all");
  members(p.max_error, "max_error", "1", 0, 10,
          "relative standard error of a pixel from which on its tile of 16 x 16 rests; 0: none rests");
  members(p.seed, "seed", 0, 4294967295.0, "of the random numbers");
  members(p.far_field, "field", k_fields,
          "of models that have both; near: at the offset of the hit; far: the mean over the fibre's width");
  members(p.point_light_radius, "point_light_radius", "m", 0, 10,
          "of every point light, a sphere of even radiance; 0: points");
  members(p.sun_angle, "sun_angle", "rad", 0, 1.5, "half the angle under which distant lights are seen; 0: points");
  members(
      p.clamp_indirect, "clamp_indirect", "1", 0, 1e6,
      "radiance that a path brings at most by light that scattered more than once; less noise, too dark; 0: no limit");
  members(
      p.twist, "twist", "1/m", -1e4, 1e4,
      "whole turns of a flat cross-section per metre of strand; each strand begins with a turn of its own by chance");
  members(p.turn_seed, "turn_seed", 0, 4294967295.0, "of the strands' turns");
  members(p.tables, "tables",
          "lookup tables of the material's layout and size, of the far field, in the place of the model");
  members(p.dual_scattering, "dual_scattering",
          "in the place of light that scatters more than once: dual scattering with fibres counted along the rays to "
          "the lights, by the densities and the spread of the pass dual_scattering, without its corrections; bounces "
          "is not read then");
  members(p.shadow, "shadow", shadow_choices(),
          "what of a light arrives at hair: by rays, or by a shadow method at the vertices; with the parameters "
          "of shadow.method where it is the scene's, and with fibre_alpha");
  members(
      p.curves, "curves", strands::curve_kind_names(),
      "what a strand's vertices are: ends of straight pieces, or control points of cubic curves; round, or flat and "
      "facing every ray");
}

const Pass& entry() {
  static const Pass pass{
      .entry = {.kind = registry::EntryKind::pass,
                .name = "reference",
                .summary = "path tracing on the CPU: light that scatters from fibre to fibre, without tables or maps",
                .source = "Kajiya 1986; Veach 1997 (multiple importance sampling); the material's own fibre model",
                .parameters = registry::table_of<Parameters>(),
                .demands = k_demands,
                .stage = registry::Stage::resolve},
      .uses = k_uses,
      .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::reference
