#include "render/generating.h"

#include "render/frame.h"

namespace cuticle::render::carry {

namespace {

constexpr std::string_view k_demands[] = {"character"};
constexpr Use k_uses[] = {may_read<PosedCharacter>(), reads<HeadVertices>(), changes<ControlHairs>()};
constexpr std::string_view k_systems[] = {"H2"};
constexpr std::string_view k_after[] = {"skin"};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      with_uses(generating({.name = "carry",
                            .summary = "control hairs carried by the frames of their roots on the moved growth mesh",
                            .source = "target positions from skinning: docs/systems.md, H2",
                            .demands = k_demands,
                            .systems = k_systems,
                            .after = k_after},
                           registry::Stage::prepare),
                k_uses);
  return pass;
}

}  // namespace cuticle::render::carry
