#pragma once
// GPU half: the aims of all vertices by one dispatch a frame, before the solver's.
#include "gpu/device.h"
#include "sim/clumping/clumping.h"

namespace cuticle::sim::clumping {

/// Of a skin: chains::SkinStrand by strand, where it has the vertices at the frame's begin (vec4), and whether the hair
/// is put onto it in this frame, which leaves targets as they are.
struct SkinBuffers {
  const gpu::Buffer *strands, *begin;
  bool onto_skin;
};

class ClumpingGpu {
 public:
  /// `vertices`: of join_clumps. Error: out_of_memory.
  static Result<std::unique_ptr<ClumpingGpu>> create(gpu::Device& device, const std::vector<ClumpedVertex>& vertices);
  /// As aim: the state of the chains before a frame, and their rest rows, of which the targets are written.
  void record(gpu::Commands& commands, const gpu::Buffer& state, const gpu::Buffer& rest, const glm::dmat3& to_rest);
  /// Before the first frame on a skin.
  Result<void> make_for_skin(gpu::Device& device);
  /// As aim_on_skin.
  void record_on_skin(gpu::Commands& commands, const gpu::Buffer& state, const gpu::Buffer& rest,
                      const SkinBuffers& skin);

 private:
  gpu::Buffer numbers_, rows_;
  gpu::Kernel kernel_, on_skin_;
  std::uint32_t count_ = 0;
};

}  // namespace cuticle::sim::clumping
