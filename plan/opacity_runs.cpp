#include "plan/opacity_runs.h"

#include "shadows/channels.h"

namespace cuticle::plan {

OpacityRuns opacity_runs(const scene::Scene& scene) {
  const shadows::Channels channels = shadows::different_channels(scene.fibre_alpha.value_or(glm::dvec3(1)));
  const bool by_powers =
      bool(shadows::root_opacity(**shadows::find_method(scene.shadow->name), scene.shadow->values, channels));
  return by_powers ? OpacityRuns{1, channels.count - 1} : OpacityRuns{channels.count, 0};
}

}  // namespace cuticle::plan
