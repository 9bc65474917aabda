#include "render/generating_gpu.h"

namespace cuticle::render::place_velocities {

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"place_velocities", recorded_by<record_velocities>};
  return table;
}

}  // namespace cuticle::render::place_velocities
