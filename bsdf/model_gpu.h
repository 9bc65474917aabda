#pragma once
// Batch evaluation of any registered model by the kernel compiled for it from the shared source.
#include <memory>

#include <cuticle/bsdf/model.h>
#include <cuticle/gpu/device.h>

namespace cuticle::bsdf {

/// The compiled kernels of one model (SPIR-V, embedded).
struct GpuModel {
  std::string_view name;
  std::span<const std::uint32_t> evaluate_spirv;
};
std::span<const GpuModel* const> gpu_models();

/// Evaluates on the device, in chunks that respect its buffer limit.
Result<void> evaluate_gpu(gpu::Device& device, const Model& model, const registry::ParameterValues& values, const Request& request,
                          std::span<glm::dvec3> out);

}  // namespace cuticle::bsdf
