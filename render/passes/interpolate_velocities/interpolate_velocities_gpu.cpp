#include "render/generating_gpu.h"

namespace cuticle::render::interpolate_velocities {

namespace {

Result<void> record(gpu::Commands& commands, const FrameResources& resources) {
  return resources.drawn_strands->record_velocities(commands, *resources.control_positions, resources.control_motion,
                                                    glm::mat3(resources.head_transform));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"interpolate_velocities", recorded_by<record>};
  return table;
}

}  // namespace cuticle::render::interpolate_velocities
