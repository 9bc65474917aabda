#include "strands/packing/packing_gpu.h"

#include "gpu/groups.h"
#include "strands/spline/drawn_gpu.h"

#include <pack_comp.spv.h>

namespace cuticle::strands {

Result<GpuPacking> GpuPacking::create(gpu::Device& device, std::uint32_t strands, std::uint32_t vertices_per_strand) {
  GpuPacking packing;
  packing.constants_ = {strands, vertices_per_strand};
  const std::size_t vertices = std::size_t(strands) * vertices_per_strand;
  CUTICLE_ASSIGN(packing.vertices_, device.make_buffer(vertices * sizeof(PackedVertex)));
  CUTICLE_ASSIGN(packing.strands_, device.make_buffer(strands * sizeof(PackedStrand)));
  CUTICLE_ASSIGN(packing.kernel_,
                 device.make_kernel(pack_comp, {4, 0, sizeof(constants_), {}, {drawn_texels(0), drawn_texels(1)}}));
  return packing;
}

void GpuPacking::record(gpu::Commands& commands, const gpu::Buffer& vertices, const gpu::Buffer& tangents) {
  const gpu::Groups groups = gpu::groups_for(constants_[0]);
  commands.dispatch(kernel_, {&vertices, &tangents, &vertices_, &strands_}, {}, gpu::bytes_of(constants_), groups.x,
                    groups.y);
}

}  // namespace cuticle::strands
