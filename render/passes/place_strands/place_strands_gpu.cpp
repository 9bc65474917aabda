#include "render/generating_gpu.h"

namespace cuticle::render::place_strands {

namespace {

Result<void> record(gpu::Commands& commands, const FrameResources& resources) {
  return resources.drawn_strands->record(commands, *resources.control_positions, glm::mat3(resources.head_transform));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"place_strands", recorded_by<record>};
  return table;
}

}  // namespace cuticle::render::place_strands
