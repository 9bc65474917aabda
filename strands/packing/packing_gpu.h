#pragma once
// GPU half of H15: drawn strands packed where they are made.
#include "gpu/device.h"
#include "strands/packing/packing.h"

namespace cuticle::strands {

/// Strands of equal vertex counts, packed anew each frame by one dispatch of one thread per strand. Tangents within the
/// bound of pack(); positions and radii within twice its, since a device may cut halves off where the CPU rounds them
/// (packing_gpu_test).
class GpuPacking {
 public:
  /// Error: out_of_memory.
  static Result<GpuPacking> create(gpu::Device& device, std::uint32_t strands, std::uint32_t vertices_per_strand);
  /// `vertices`: vec4 (position, radius); `tangents`: vec4 (unit tangent, anything).
  void record(gpu::Commands& commands, const gpu::Buffer& vertices, const gpu::Buffer& tangents);
  const gpu::Buffer& vertices() const { return vertices_; }  ///< PackedVertex
  const gpu::Buffer& strands() const { return strands_; }    ///< PackedStrand

 private:
  gpu::Kernel kernel_;
  gpu::Buffer vertices_, strands_;
  std::array<std::uint32_t, 2> constants_{};  ///< strands, vertices of each
};

}  // namespace cuticle::strands
