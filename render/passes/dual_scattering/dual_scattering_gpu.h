#pragma once
// What shaders that include lit.glsl are given.
#include "render/pass_gpu.h"
#include "render/passes/dual_scattering/dual_scattering.h"

namespace cuticle::render::dual_scattering {

/// DualTerms of dual_scattering.glsl.
struct Terms {
  const gpu::Buffer* values = nullptr;
};

/// The two specialisation constants, after those of `before`.
std::vector<std::uint32_t> with_dual_scattering(std::vector<std::uint32_t> before, const Resources& resources);

/// The two buffers; `unused` takes the place of what the scene does not ask for.
struct Inputs {
  const gpu::Buffer *terms, *visibility;
};
Inputs inputs_of(const Resources& resources, const gpu::Buffer& unused);

}  // namespace cuticle::render::dual_scattering
