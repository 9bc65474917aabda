#include "render/generating_gpu.h"
#include "strands/spline/smooth_gpu.h"

namespace cuticle::render::smooth_strands {

namespace {

Result<void> record(gpu::Commands& commands, const Resources& resources) {
  return resources.get<StrandMaker>().generator->record_smooth(commands, *resources.get<ControlHairs>().positions);
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"smooth_strands", recorded_by<record>};
  return table;
}

}  // namespace cuticle::render::smooth_strands
