#pragma once
// The contact kernel; the solver that owns the strands dispatches it.
#include <string_view>

#include "gpu/device.h"

namespace cuticle::sim::colliders {

inline constexpr std::string_view k_contact_pass = "colliders";

/// Pushes the strands that StrandBuffers::reach lists out of the spheres, keeping lengths, and ends their substep:
/// buffers and constants as in sim/strand_kernel.glsl, one thread per strand of the list, whose length is in
/// ends_substep.
Result<gpu::Kernel> make_contact_kernel(gpu::Device& device, const gpu::ShaderInterface& interface);

}  // namespace cuticle::sim::colliders
