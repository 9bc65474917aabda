#include "render/generating.h"

namespace cuticle::render::skin {

namespace {

constexpr std::string_view k_demands[] = {"moving_skin"};
constexpr std::string_view k_systems[] = {"H1"};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      generating({.name = "skin",
                  .summary = "the growth mesh moved by its joints, linear blend or dual quaternions",
                  .source = "Kavan et al. 2008, Geometric skinning with approximate dual quaternion blending",
                  .demands = k_demands,
                  .systems = k_systems},
                 registry::Stage::prepare);
  return pass;
}

}  // namespace cuticle::render::skin
