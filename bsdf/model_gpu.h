#pragma once
// Batch evaluation of any registered model by the kernel compiled for it from the shared source.
#include <memory>
#include <optional>

#include "bsdf/model.h"
#include "gpu/device.h"

namespace cuticle::bsdf {

/// The compiled kernels of one model (SPIR-V, embedded).
struct GpuModel {
  std::string_view name;
  std::span<const std::uint32_t> evaluate_spirv;
  std::span<const std::uint32_t> sample_spirv;
};
std::span<const GpuModel> gpu_models();  // written by CMake (bsdf/CMakeLists.txt)

/// Error: usage, where the device is Mesa's software Vulkan and would cut the model's loops short (Model::loop_rounds).
Result<void> check_loops(const gpu::Device& device, const Model& model, const registry::ParameterValues& values,
                         Quantity quantity);

/// A model's kernels on a device, made once for many batches. Belongs to the device, which must outlive it.
class GpuEvaluator {
 public:
  /// Error: usage where the model has no kernel, or what the device says.
  static Result<GpuEvaluator> make(gpu::Device& device, const Model& model);
  /// In float, in chunks that respect the device's buffer limit; the same bits from run to run. Errors: as
  /// check_request; usage where software Vulkan would cut the model's loops short.
  Result<void> evaluate(const registry::ParameterValues& values, const Request& request, std::span<glm::dvec3> out);
  /// What `record` reads of parameter values, on the device.
  Result<gpu::Buffer> upload(const registry::ParameterValues& values) const;
  /// Records the evaluation of `count` points that lie on the device, six floats each as in Point, with nothing
  /// checked; three floats each to `results`. `parameters`: what `upload` gave.
  void record(gpu::Commands& commands, const gpu::Buffer& parameters, const gpu::Buffer& points,
              const gpu::Buffer& results, std::uint32_t count, Quantity quantity, int lobe) const;
  /// The same of S, summed over the lobes, in as many workgroups of 64 points as `numbers` says on three axes, 32 bits
  /// each, from `offset` bytes on; at most `count` points.
  void record_counted(gpu::Commands& commands, const gpu::Buffer& parameters, const gpu::Buffer& points,
                      const gpu::Buffer& results, std::uint32_t count, const gpu::Buffer& numbers,
                      std::size_t offset) const;
  /// Draws directions in float, as bsdf::sample does on the CPU; its kernel is compiled at the first call. Errors:
  /// usage, where the model has no sampler; as check_queries.
  Result<void> sample(const registry::ParameterValues& values, std::span<const SampleQuery> queries,
                      std::span<Sample> out);

 private:
  GpuEvaluator(gpu::Device& device, const Model& model, gpu::Kernel kernel)
      : device_(&device), model_(&model), kernel_(std::move(kernel)) {}
  Result<void> evaluate_chunk(const gpu::Buffer& parameters, const Request& request, std::span<glm::dvec3> out);
  Result<void> make_sample_kernel();
  Result<void> sample_chunk(const gpu::Buffer& parameters, std::span<const SampleQuery> queries, std::span<Sample> out);

  gpu::Device* device_;
  const Model* model_;
  gpu::Kernel kernel_;
  std::optional<gpu::Kernel> sample_kernel_;
};

/// One batch on the device: GpuEvaluator for callers that have only one.
Result<void> evaluate_gpu(gpu::Device& device, const Model& model, const registry::ParameterValues& values,
                          const Request& request, std::span<glm::dvec3> out);

}  // namespace cuticle::bsdf
