#include "render/generating_gpu.h"

namespace cuticle::render::interpolate_velocities {

namespace {

Result<void> record(gpu::Commands& commands, const Resources& resources) {
  return resources.get<StrandMaker>().strands->record_velocities(commands, *resources.get<ControlHairs>().positions,
                                                                 resources.get<ControlHairs>().motion,
                                                                 glm::mat3(resources.get<Surfaces>().head_transform));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"interpolate_velocities", recorded_by<record>};
  return table;
}

}  // namespace cuticle::render::interpolate_velocities
