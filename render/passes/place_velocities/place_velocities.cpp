#include "render/generating.h"

namespace cuticle::render::place_velocities {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "output_velocity", "seen_segments",
                                          "strands_as_given"};
constexpr std::string_view k_systems[] = {"F2"};
constexpr std::string_view k_after[] = {"place_strands"};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      generating({.name = "place_velocities",
                  .summary = "velocities of the vertices of strands that are drawn as they are given",
                  .source = "Frostbite, Every Strand Counts (2023): what physics hands over",
                  .demands = k_demands,
                  .systems = k_systems,
                  .after = k_after});
  return pass;
}

}  // namespace cuticle::render::place_velocities
