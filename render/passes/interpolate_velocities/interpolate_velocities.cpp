#include "render/generating.h"

#include "render/frame.h"
#include "render/inputs.h"

namespace cuticle::render::interpolate_velocities {

namespace {

constexpr std::string_view k_demands[] = {"strands_interpolated"};
constexpr Use k_uses[] = {reads<ControlHairs>(), reads<StrandMaker>(), reads<DrawnHair>(), reads<Surfaces>(),
                          writes<DrawnVelocities>()};
constexpr std::string_view k_systems[] = {"F2"};
constexpr std::string_view k_after[] = {"interpolate_strands"};

}  // namespace

const Pass& entry() {
  static const Pass pass = with_uses(
      [] {
        Pass made = generating({.name = "interpolate_velocities",
                                .summary = "velocities of the drawn strands' vertices from those of the control hairs",
                                .source = "Frostbite, Every Strand Counts (2023): what physics hands over",
                                .demands = k_demands,
                                .systems = k_systems,
                                .after = k_after});
        made.entry.dispatches = [](const registry::ParameterValues&, const registry::FrameShape& shape) {
          return 1 + dispatches_of_drawn(shape);  // smoothed control hairs first
        };
        return made;
      }(),
      k_uses);
  return pass;
}

}  // namespace cuticle::render::interpolate_velocities
