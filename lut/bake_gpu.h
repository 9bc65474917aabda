#pragma once
// Baking on the device: any layout of any registered model, through the model's batch kernel.
#include <optional>

#include "lut/bake_kernel_gpu.h"

namespace cuticle::lut {

/// The tables of one model, layout and size, baked as often as parameters change by a kernel that is compiled once.
/// Belongs to the device; the model and the layout must live as long.
class DeviceBaker {
 public:
  DeviceBaker(gpu::Device& device, const bsdf::Model& model, const Layout& layout, int size)
      : device_(&device), model_(&model), layout_(&layout), size_(size) {}
  /// As bake_gpu; the first call compiles.
  Result<TableSet> bake(const registry::ParameterValues& values);
  /// Of the last bake's submission; empty where the device made no table.
  const gpu::SubmitCost& last_cost() const { return cost_; }

 private:
  Result<void> compile(std::vector<const TableLayout*> layouts);
  Result<void> fill(TableSet& set);

  gpu::Device* device_;
  const bsdf::Model* model_;
  const Layout* layout_;
  int size_;
  std::optional<BakeKernel> kernel_;
  gpu::Buffer texels_;
  gpu::SubmitCost cost_;
};

/// As `bake`, in float on the device; tables with channels of the average fibre or of a solver are made on the CPU.
/// Agrees with `bake` to half precision (lut_gpu_test).
Result<TableSet> bake_gpu(gpu::Device& device, const bsdf::Model& model, const registry::ParameterValues& values,
                          const Layout& layout, int size);
/// Tables as rgba16f textures (missing channels 0), in the order of the layout, sampled bilinearly and clamped; with
/// mip levels also between those, where a fragment shader's lookups lie more than a texel apart.
Result<std::vector<gpu::Texture>> upload(gpu::Device& device, const TableSet& set, bool mip_levels = false);

}  // namespace cuticle::lut
