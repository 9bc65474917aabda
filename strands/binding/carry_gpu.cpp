#include "strands/binding/carry_gpu.h"

#include "gpu/groups.h"

#include <carry_comp.spv.h>

namespace cuticle::strands {

Result<GpuCarry> GpuCarry::create(gpu::Device& device, const RestOnMesh& rest) {
  if (rest.locals.empty()) return bad_input("groom: no vertex to carry, at least 1 is needed");
  GpuCarry carry;
  carry.count_ = std::uint32_t(rest.locals.size());
  CUTICLE_ASSIGN(carry.corners_, (gpu::make_buffer_from<std::array<std::uint32_t, 4>>(device, rest.corners)));
  CUTICLE_ASSIGN(carry.weights_, gpu::make_buffer_from<glm::vec4>(device, rest.weights));
  CUTICLE_ASSIGN(carry.locals_, gpu::make_buffer_from<glm::vec4>(device, rest.locals));
  CUTICLE_ASSIGN(carry.strand_of_, gpu::make_buffer_from<std::uint32_t>(device, rest.strand_of));
  CUTICLE_ASSIGN(carry.positions_, device.make_buffer(rest.locals.size() * sizeof(glm::vec4)));
  CUTICLE_ASSIGN(carry.kernel_,
                 device.make_kernel(carry_comp, {.storage_buffers = 7, .push_constant_bytes = sizeof(std::uint32_t)}));
  return carry;
}

void GpuCarry::record(gpu::Commands& commands, const gpu::Buffer& mesh_positions, const gpu::Buffer& mesh_normals) {
  const gpu::Groups groups = gpu::groups_for(count_);
  commands.begin_pass("carry");
  commands.dispatch(kernel_, {&mesh_positions, &mesh_normals, &corners_, &weights_, &locals_, &strand_of_, &positions_},
                    {}, gpu::bytes_of(count_), groups.x, groups.y);
  commands.end_pass();
}

}  // namespace cuticle::strands
