#pragma once
// A character's skin and the control hairs on it, frame by frame; nothing comes back from the device.
#include <memory>

#include "plan/strand_set.h"
#include "render/pass_gpu.h"

namespace cuticle::plan {

class CharacterMotion {
 public:
  /// Error: bad_input naming the clip that is not there; out_of_memory. `set` has a character.
  static Result<std::unique_ptr<CharacterMotion>> create(gpu::Device& device, const scene::Scene& scene,
                                                         const StrandSet& set);
  /// Poses the joints for a frame, frame 0 at the scene's start time; the clip repeats.
  void move_to(int frame);
  /// For the frame last moved to.
  render::PosedCharacter posed() { return {&mesh_, &strands_, motions_, method_}; }
  /// The passes "skin" and "carry" for it.
  Result<void> record(gpu::Commands& commands);

  const gpu::Buffer& positions() const { return strands_.positions(); }  ///< world, vec4 per control vertex
  const gpu::Buffer& mesh_positions() const { return mesh_.positions(); }
  const gpu::Buffer& mesh_normals() const { return mesh_.normals(); }
  /// Of the skin, wider by the longest control hair.
  const strands::Bounds& bounds() const { return bounds_; }

 private:
  CharacterMotion() = default;
  std::shared_ptr<const strands::Character> character_;
  int clip_ = -1;
  strands::Skinning method_ = strands::Skinning::dual_quaternion;
  double start_time_ = 0, frame_duration_ = 0, longest_hair_ = 0;
  strands::GpuSkin mesh_;
  strands::GpuCarry strands_;
  std::vector<strands::JointMotion> motions_;
  strands::Mesh moved_;
  strands::Bounds bounds_;
};

}  // namespace cuticle::plan
