#include "render/passes/velocity/velocity.h"

#include "render/shading.h"

namespace cuticle::render::velocity {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "output_velocity", "seen_segments"};
constexpr std::string_view k_after[] = {"pixel_depth"};
constexpr std::string_view k_systems[] = {"F8"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.nodes, "nodes", 2, 128, "of the grid over the hair, along each axis");
}

const Pass& entry() {
  static const Pass pass{.entry = {.kind = registry::EntryKind::pass,
                                   .name = "velocity",
                                   .summary = "motion vectors of the hair: pixels to the world by their depth, moved "
                                              "back by a coarse grid of the control hairs' displacements",
                                   .source = "Frostbite, Every Strand Counts (2023): hair velocity",
                                   .parameters = registry::table_of<Parameters>(),
                                   .demands = k_demands,
                                   .stage = registry::Stage::resolve,
                                   .systems = k_systems,
                                   .dispatches = always<8>,  // largest, splat, mean, four fills, pixels
                                   .after = k_after},
                         .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::velocity
