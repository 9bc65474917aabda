#pragma once
// GPU half of H2: strands follow a mesh that stays on the device.
#include "gpu/device.h"
#include "strands/binding/binding.h"

namespace cuticle::strands {

/// Strands carried by the pass "carry": one dispatch of one thread per vertex. Agrees with carry() within 2e-6
/// of the mesh's size (skinning_gpu_test).
class GpuCarry {
 public:
  /// Error: bad_input where there is no vertex; out_of_memory.
  static Result<GpuCarry> create(gpu::Device& device, const RestOnMesh& rest);
  /// `mesh_positions`, `mesh_normals`: vec4 per vertex of the mesh, as GpuSkin gives them.
  void record(gpu::Commands& commands, const gpu::Buffer& mesh_positions, const gpu::Buffer& mesh_normals);
  const gpu::Buffer& positions() const { return positions_; }  ///< vec4 per vertex, world metres

 private:
  gpu::Kernel kernel_;
  gpu::Buffer corners_, weights_, locals_, strand_of_, positions_;
  std::uint32_t count_ = 0;
};

}  // namespace cuticle::strands
