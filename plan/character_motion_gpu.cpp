#include "plan/character_motion_gpu.h"

#include <algorithm>

#include <glm/common.hpp>

namespace cuticle::plan {

Result<std::unique_ptr<CharacterMotion>> CharacterMotion::create(gpu::Device& device, const scene::Scene& scene,
                                                                 const StrandSet& set) {
  std::unique_ptr<CharacterMotion> motion(new CharacterMotion);
  const strands::Character& character = *set.character;
  const scene::CharacterSource& source = *scene.character;
  motion->character_ = set.character;
  if (!source.clip.empty()) {
    CUTICLE_ASSIGN(motion->clip_, strands::find_clip(character, source.clip));
  }
  motion->method_ = source.dual_quaternions ? strands::Skinning::dual_quaternion : strands::Skinning::linear_blend;
  motion->start_time_ = source.start_time;
  motion->frame_duration_ = 1 / scene.frames_per_second;
  for (std::size_t s = 0; s < set.control.strand_count(); ++s)
    motion->longest_hair_ = std::max(motion->longest_hair_, strands::strand_length(set.control, s));
  const std::vector<float> hair_grows(character.mesh.positions.size(), 1.0f);
  CUTICLE_ASSIGN(motion->mesh_, strands::GpuSkin::create(device, character.mesh, character.influences,
                                                         character.joints.size(), hair_grows));
  const strands::RestOnMesh rest = strands::rest_on_mesh(set.control, character.mesh, set.control_roots);
  CUTICLE_ASSIGN(motion->strands_, strands::GpuCarry::create(device, rest));
  motion->move_to(0);
  return motion;
}

void CharacterMotion::move_to(int frame) {
  const double time = start_time_ + frame * frame_duration_;
  const double place = clip_ < 0 ? 0 : strands::looped(character_->clips[std::size_t(clip_)], time);
  motions_ = strands::joint_motions(strands::joint_matrices(*character_, clip_, place));
  strands::skin(character_->mesh, character_->influences, motions_, method_, moved_);
  bounds_ = {moved_.positions.front(), moved_.positions.front()};
  for (const glm::vec3& point : moved_.positions) {
    bounds_.lower = glm::min(bounds_.lower, point);
    bounds_.upper = glm::max(bounds_.upper, point);
  }
  // Curves through the control vertices may bulge past them.
  const glm::vec3 margin(float(1.1 * longest_hair_ + 1e-4));
  bounds_ = {bounds_.lower - margin, bounds_.upper + margin};
}

Result<void> CharacterMotion::record(gpu::Commands& commands) {
  CUTICLE_TRY(mesh_.record(commands, motions_, method_));
  strands_.record(commands, mesh_.positions(), mesh_.normals());
  return {};
}

}  // namespace cuticle::plan
