#include "sim/colliders/contact_gpu.h"

#include <colliders_comp.spv.h>

#include "sim/solver_gpu.h"

namespace cuticle::sim::colliders {

Result<gpu::Kernel> make_contact_kernel(gpu::Device& device, const gpu::ShaderInterface& interface) {
  return device.make_kernel(colliders_comp, interface);
}

const GpuEffect& gpu_entry() {
  static const GpuEffect effect{"colliders", nullptr};
  return effect;
}

}  // namespace cuticle::sim::colliders
