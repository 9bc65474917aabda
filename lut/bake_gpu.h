#pragma once
// Baking on the device: any layout of any registered model, through the model's batch kernel.
#include "gpu/device.h"
#include "lut/table_set.h"

namespace cuticle::lut {

/// As `bake`, in float on the device; tables with channels of the average fibre or of a solver are made on the CPU.
/// Agrees with `bake` to half precision (lut_gpu_test).
Result<TableSet> bake_gpu(gpu::Device& device, const bsdf::Model& model, const registry::ParameterValues& values,
                          const Layout& layout, int size);
/// Tables as rgba16f textures (missing channels 0), in the order of the layout, sampled bilinearly and clamped; with mip levels also
/// between those, where a fragment shader's lookups lie more than a texel apart.
Result<std::vector<gpu::Texture>> upload(gpu::Device& device, const TableSet& set, bool mip_levels = false);

}  // namespace cuticle::lut
