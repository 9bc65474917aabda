#pragma once
// GPU half of H1: the growth mesh stays on the device; only the joints are sent each frame.
#include <memory>

#include "gpu/device.h"
#include "strands/skinning/skinning.h"

namespace cuticle::strands {

/// A mesh in its bind pose on the device, moved by the pass "skin": one dispatch of one thread per vertex.
/// Agrees with skin() within 2e-6 of the mesh's size (skinning_gpu_test).
class GpuSkin {
 public:
  /// `tags`: one number per vertex that is passed on in the fourth component of positions (the head pass: 1 where hair
  /// grows); may be empty. Errors: out_of_memory; bad_input for a mesh without vertices.
  static Result<GpuSkin> create(gpu::Device& device, const Mesh& bind, std::span<const Influences> influences,
                                std::size_t joint_count, std::span<const float> tags = {});
  Result<void> record(gpu::Commands& commands, std::span<const JointMotion> motions, Skinning method);
  const gpu::Buffer& positions() const { return moved_positions_; }  ///< vec4 (world position, tag) per vertex
  const gpu::Buffer& normals() const { return moved_normals_; }      ///< vec4 (unit normal, 0) per vertex

 private:
  gpu::Kernel kernel_;
  gpu::Buffer positions_, normals_, joints_, weights_, motions_, moved_positions_, moved_normals_;
  std::uint32_t count_ = 0;
  std::size_t joint_count_ = 0;
};

}  // namespace cuticle::strands
