#include "render/generating.h"

#include "render/frame.h"
#include "render/inputs.h"

namespace cuticle::render::place_velocities {

namespace {

constexpr std::string_view k_demands[] = {"strands_as_given"};
constexpr Use k_uses[] = {reads<ControlHairs>(), reads<StrandMaker>(), reads<DrawnHair>(), reads<Surfaces>(),
                          writes<DrawnVelocities>()};
constexpr std::string_view k_systems[] = {"F2"};
constexpr std::string_view k_after[] = {"place_strands"};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      with_uses(writing_drawn({.name = "place_velocities",
                               .summary = "velocities of the vertices of strands that are drawn as they are given",
                               .source = "Frostbite, Every Strand Counts (2023): what physics hands over",
                               .demands = k_demands,
                               .systems = k_systems,
                               .after = k_after}),
                k_uses);
  return pass;
}

}  // namespace cuticle::render::place_velocities
