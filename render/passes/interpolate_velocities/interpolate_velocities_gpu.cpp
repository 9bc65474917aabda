#include "render/generating_gpu.h"

namespace cuticle::render::interpolate_velocities {

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"interpolate_velocities", recorded_by<record_velocities>};
  return table;
}

}  // namespace cuticle::render::interpolate_velocities
