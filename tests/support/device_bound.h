#pragma once
// What a device may be off by in a test.
#include "gpu/device.h"

namespace cuticle::tests {

/// The bound for this device. Software Vulkan rounds every operation as the CPU does. A GPU may join a product and a sum
/// into one rounding, and divides and takes roots to 2.5 roundings (Vulkan 1.3, precision of operations): `on_a_gpu` is
/// what an H200 was measured to need (bench/results/gpu_h200.txt).
inline double bound_for(const gpu::Device& device, double on_software, double on_a_gpu) {
  return device.info().is_software ? on_software : on_a_gpu;
}

}  // namespace cuticle::tests
