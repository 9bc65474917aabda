#include "render/passes/cards/cards.h"

#include <vector>

#include "render/shading.h"
#include "strands/cards/cards.h"

namespace cuticle::render::cards {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr std::string_view k_demands[] = {"strands", "output_color", "drawn_by_cards"};
constexpr std::string_view k_after[] = {"head", "fins", "floor", "dual_scattering"};
constexpr std::string_view k_systems[] = {"A1", "A2", "A3", "A4", "A5", "A6", "A7", "A8", "A9", "A10"};
constexpr std::string_view k_schemes[] = {"four_pass", "three_pass"};
constexpr std::string_view k_orders[] = {"static", "groups", "cards"};
constexpr std::string_view k_depth_writes[] = {"printed", "off", "front", "both"};
constexpr Parameter k_parameters[] = {
    {.name = "scheme",
     .type = ParameterType::choice,
     .default_text = "four_pass",
     .choices = k_schemes,
     .summary = "four_pass: depth of the opaque parts first, then these where their depth is equal, back faces, front "
                "faces; three_pass: without the first"},
    {.name = "order",
     .type = ParameterType::choice,
     .default_text = "static",
     .choices = k_orders,
     .summary = "static: inside to outside, as computed beforehand; groups: groups (swings_from) by their depth, in "
                "those that swing cards by theirs; cards: all by depth"},
    {.name = "transparent_depth",
     .type = ParameterType::choice,
     .default_text = "printed",
     .choices = k_depth_writes,
     .summary = "which transparent faces write depth; printed: the front faces of three_pass, none of four_pass"},
    {.name = "opaque_alpha",
     .minimum = 0.01,
     .maximum = 1,
     .default_text = "0.9",
     .summary = "alpha from which on a texel is opaque"},
    {.name = "count_fragments",
     .type = ParameterType::boolean,
     .default_text = "false",
     .summary = "fragments of each draw are counted, by the shader and by the device's statistics, and told"},
};

const std::vector<Parameter>& parameters() {
  static const std::vector<Parameter> all = [] {
    std::vector<Parameter> table(std::begin(k_parameters), std::end(k_parameters));
    const registry::ParameterTable cards = strands::card_parameters();
    table.insert(table.end(), cards.begin(), cards.end());
    return table;
  }();
  return all;
}

/// Cards follow their strands; for an order at run time their depths are taken and sorted.
std::uint32_t dispatches(const registry::ParameterValues& values, const registry::FrameShape&) {
  return values.choice("order") == "static" ? 1 : 3;
}

}  // namespace

const Pass& entry() {
  static const Pass pass = of_whole_pictures(
      shading({.name = "cards",
               .summary = "strands as textured cards with ambient occlusion, opaque and transparent parts in passes",
               .source = "Scheuermann 2004, Hair Rendering and Shading (GDC)",
               .parameters = parameters(),
               .demands = k_demands,
               .systems = k_systems,
               .dispatches = dispatches,
               .draws = 4,
               .after = k_after}));
  return pass;
}

}  // namespace cuticle::render::cards
