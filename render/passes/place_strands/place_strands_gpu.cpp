#include "render/generating_gpu.h"

namespace cuticle::render::place_strands {

namespace {

Result<void> record(gpu::Commands& commands, const Resources& resources) {
  return resources.get<StrandMaker>().strands->record(commands, *resources.get<ControlHairs>().positions,
                                                      glm::mat3(resources.get<Surfaces>().head_transform));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"place_strands", recorded_by<record>};
  return table;
}

}  // namespace cuticle::render::place_strands
