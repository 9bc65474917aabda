#include "render/generating.h"

#include "render/frame.h"

namespace cuticle::render::skin {

namespace {

constexpr std::string_view k_demands[] = {"character"};
constexpr Use k_uses[] = {may_read<PosedCharacter>(), writes<HeadVertices>()};
constexpr std::string_view k_systems[] = {"H1"};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      with_uses(generating({.name = "skin",
                            .summary = "the growth mesh moved by its joints, linear blend or dual quaternions",
                            .source = "Kavan et al. 2008, Geometric skinning with approximate dual quaternion blending",
                            .demands = k_demands,
                            .systems = k_systems},
                           registry::Stage::prepare),
                k_uses);
  return pass;
}

}  // namespace cuticle::render::skin
