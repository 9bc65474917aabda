#pragma once
// How often a scene's shadow method runs for each light: hair whose opacity differs by channel may need it for each.
#include <cstdint>

#include "scene/scene.h"

namespace cuticle::plan {

/// `runs`: of the method, for each light; `powers`: of what one run left, taken to the power of another opacity
/// (shadows/channels.h). The scene has a shadow method that the catalogue holds.
struct OpacityRuns {
  std::uint32_t runs = 1, powers = 0;
};
OpacityRuns opacity_runs(const scene::Scene& scene);

}  // namespace cuticle::plan
