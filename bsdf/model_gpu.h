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

/// A model's kernel on a device, made once for many batches. Belongs to the device, which must outlive it.
class GpuEvaluator {
 public:
  /// Error: usage where the model has no kernel, or what the device says.
  static Result<GpuEvaluator> make(gpu::Device& device, const Model& model);
  /// In float, in chunks that respect the device's buffer limit; the same bits from run to run. Errors: as
  /// check_request.
  Result<void> evaluate(const registry::ParameterValues& values, const Request& request, std::span<glm::dvec3> out);

 private:
  GpuEvaluator(gpu::Device& device, const Model& model, gpu::Kernel kernel)
      : device_(&device), model_(&model), kernel_(std::move(kernel)) {}
  Result<void> evaluate_chunk(const gpu::Buffer& parameters, const Request& request, std::span<glm::dvec3> out);

  gpu::Device* device_;
  const Model* model_;
  gpu::Kernel kernel_;
};

/// One batch on the device: GpuEvaluator for callers that have only one.
Result<void> evaluate_gpu(gpu::Device& device, const Model& model, const registry::ParameterValues& values,
                          const Request& request, std::span<glm::dvec3> out);

}  // namespace cuticle::bsdf
