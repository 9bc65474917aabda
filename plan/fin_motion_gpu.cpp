#include "plan/fin_motion_gpu.h"

#include "sim/cloth/cloth.h"

namespace cuticle::plan {
namespace {

/// Without those that are between strands, or of strands alone: fins are a cloth, whose solver has none of them.
sim::EffectBlocks effects_of_fins(sim::EffectBlocks effects) {
  for (const char* of_strands : {"clumping", "sleep", "strand_interaction"}) effects.erase(of_strands);
  return effects;
}

}  // namespace

Result<std::unique_ptr<FinMotion>> FinMotion::create(std::shared_ptr<gpu::Device> device, const scene::Scene& scene,
                                                     const StrandSet& set, const Plan& plan) {
  std::unique_ptr<FinMotion> motion(new FinMotion(std::move(device), scene, set, plan));
  const std::size_t bytes = set.fins.positions.size() * sizeof(glm::vec4);
  CUTICLE_ASSIGN(motion->positions_, motion->device_->make_buffer(bytes));
  CUTICLE_ASSIGN(motion->normals_, motion->device_->make_buffer(bytes));
  return motion;
}

Result<void> FinMotion::restart(const sim::EffectBlocks& effects) {
  cloth_.reset();
  if (!find_pass(plan_, sim::cloth::Cloth::name)) return {};
  const auto given = sim::find_effect<sim::cloth::Cloth>(scene_.simulation.effects);
  CUTICLE_ASSIGN(cloth_, sim::make_cloth(set_.fins, set_.fin_weights, given.value_or(sim::cloth::Cloth{}),
                                         effects_of_fins(effects)));
  return {};
}

Result<void> FinMotion::advance(const sim::FrameInput& input) {
  if (!cloth_) return carry(input.head_end);
  sim::FrameInput spheres_only = input;
  spheres_only.boxes = {};
  spheres_only.fields = {};
  std::vector<sim::MovingCollider> moving;
  for (const sim::MovingCollider& collider : input.moving)
    if (std::holds_alternative<Sphere>(collider.shape)) moving.push_back(collider);
  spheres_only.moving = moving;
  CUTICLE_TRY(cloth_->advance(spheres_only));
  CUTICLE_ASSIGN(sim::State state, cloth_->state());
  moved_.positions = std::move(state.positions);
  return upload();
}

Result<void> FinMotion::carry(const glm::dmat4& head) {
  moved_.positions = strands::transformed(set_.fins, head).positions;
  return upload();
}

Result<void> FinMotion::upload() {
  strands::compute_normals(moved_);
  std::vector<glm::vec4> positions, normals;
  for (std::size_t i = 0; i < moved_.positions.size(); ++i) {
    positions.emplace_back(moved_.positions[i], set_.fin_weights[i]);
    normals.emplace_back(moved_.normals[i], 0);
  }
  CUTICLE_TRY(device_->upload(positions_, std::as_bytes(std::span<const glm::vec4>(positions))));
  return device_->upload(normals_, std::as_bytes(std::span<const glm::vec4>(normals)));
}

}  // namespace cuticle::plan
