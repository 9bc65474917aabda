#include "plan/strand_motion_gpu.h"

#include <cmath>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "plan/traced_scene_runner.h"
#include "sim/control/control_gpu.h"

namespace cuticle::plan {

namespace {

/// Whether the scene's solver can follow a character's skin.
Result<void> check_on_skin(const scene::Scene& scene) {
  if (!scene.simulation.solver) return {};
  CUTICLE_ASSIGN(const sim::Effect* solver, sim::find_effect(scene.simulation.solver->name));
  if (!solver->follows_skin)
    return usage_error(
        fmt::format("simulation: hair on a character's skin cannot have the solver '{}'", solver->entry.name),
        "choose the solver 'classic', 'exact' or 'rod'");
  for (const char* effect : {"control", "strand_interaction", "clumping", "sleep"})
    if (scene.simulation.effects.contains(effect))
      return usage_error(fmt::format("simulation: hair on a character's skin cannot have the effect '{}'", effect),
                         "leave it out");
  return {};
}

}  // namespace

Result<std::unique_ptr<StrandMotion>> StrandMotion::create(std::shared_ptr<gpu::Device> device,
                                                           const scene::Scene& scene, const StrandSet& set,
                                                           const Plan& plan) {
  std::unique_ptr<StrandMotion> motion(new StrandMotion(std::move(device), scene, set, plan));
  CUTICLE_ASSIGN(motion->path_, HeadPath::create(scene, set.pivot));
  if (set.character) {
    CUTICLE_TRY(check_on_skin(scene));
    CUTICLE_ASSIGN(motion->character_, CharacterMotion::create(*motion->device_, scene, set));
  } else if (!scene.simulation.solver) {
    CUTICLE_ASSIGN(motion->carried_, motion->device_->make_buffer(set.control.vertex_count() * sizeof(glm::vec4)));
  }
  if (!set.fins.triangles.empty()) {
    CUTICLE_ASSIGN(motion->fins_, FinMotion::create(motion->device_, scene, set, plan));
  }
  motion->hands_over_motion_ = find_pass(plan, "velocity") != nullptr;
  if (motion->hands_over_motion_ && !scene.simulation.solver) {
    CUTICLE_ASSIGN(motion->before_, motion->device_->make_buffer(set.control.vertex_count() * sizeof(glm::vec4)));
  }
  return motion;
}

const gpu::Buffer& StrandMotion::positions() const {
  if (solver_) return solver_->positions();
  return character_ ? character_->positions() : carried_;
}

strands::ControlMotion StrandMotion::control_motion() const {
  if (!hands_over_motion_) return {};
  if (solver_) return {&solver_->velocities(), 0};
  return {&before_, float(1 / scene_.frames_per_second)};
}

Result<void> StrandMotion::restart() {
  frame_ = -1;
  if (!scene_.simulation.solver) return {};
  const scene::Block& block = *scene_.simulation.solver;
  CUTICLE_ASSIGN(const sim::GpuEffect* effect, sim::find_gpu_effect(block.name));
  const sim::EffectBlocks effects = planned_effects(scene_, plan_);
  CUTICLE_ASSIGN(solver_, effect->create(device_, set_.control, block.values, effects));
  if (fins_) CUTICLE_TRY(fins_->restart(effects));
  if (const auto control = sim::find_effect<sim::control::Control>(effects)) {
    CUTICLE_ASSIGN(solver_, sim::control::controlled_gpu(device_, std::move(solver_), set_.control, *control));
  }
  return settle();
}

Result<void> StrandMotion::settle() {
  const int frames = int(std::ceil(scene_.simulation.settle_time * scene_.frames_per_second));
  for (int k = 0; k < frames; ++k) CUTICLE_TRY(simulate(0, nullptr));
  return {};
}

/// From the frame before to this one.
sim::FrameInput StrandMotion::input_of(int frame) const {
  const bool collides = find_pass(plan_, "colliders") != nullptr;
  return {.duration = 1 / scene_.frames_per_second,
          .head_begin = path_.at(std::max(0, frame - 1)),
          .head_end = path_.at(frame),
          .colliders = collides ? set_.colliders : std::span<const Sphere>(),
          .boxes = collides ? set_.boxes : std::span<const RoundedBox>(),
          .fields = collides ? set_.fields : std::span<const sim::FieldPointer>(),
          .moving = collides ? set_.moving : std::span<const sim::MovingCollider>(),
          .clock_begin = std::max(0, frame - 1) / scene_.frames_per_second,
          .clock_end = frame / scene_.frames_per_second};
}

Result<gpu::SubmitCost> StrandMotion::simulate(int frame, Trace* trace) {
  gpu::Commands commands = device_->record();
  const sim::FrameInput input = input_of(frame);
  if (fins_) CUTICLE_TRY(fins_->advance(input));
  if (character_) {
    character_->move_to(frame);
    CUTICLE_TRY(character_->record(commands));
    CUTICLE_TRY(solver_->record_on_skin(commands, input, character_->positions()));
  } else {
    CUTICLE_TRY(solver_->record(commands, input));
  }
  return device_->submit(std::move(commands), trace);
}

Result<gpu::SubmitCost> StrandMotion::advance_to(int frame, Trace* trace) {
  if (character_ && !scene_.simulation.solver) {
    CUTICLE_TRY(move_character(frame));
    return gpu::SubmitCost{};
  }
  if (frame_ < 0 || frame < frame_) CUTICLE_TRY(restart());
  gpu::SubmitCost cost;
  for (int next = solver_ ? frame_ + 1 : frame; next <= frame; ++next) {
    head_ = path_.at(next);
    if (!solver_) break;
    CUTICLE_ASSIGN(cost, simulate(next, trace));
  }
  frame_ = frame;
  if (!solver_) CUTICLE_TRY(carry_rigidly(frame));
  CUTICLE_TRY(measure());
  return cost;
}

Result<void> StrandMotion::carry_rigidly(int frame) {
  CUTICLE_TRY(carry(carried_, head_));
  if (before_) CUTICLE_TRY(carry(before_, path_.at(std::max(0, frame - 1))));
  return fins_ ? fins_->carry(head_) : Result<void>{};
}

Result<void> StrandMotion::carry(const gpu::Buffer& places, const glm::dmat4& head) {
  std::vector<glm::vec4> carried;
  for (const glm::vec3& position : set_.control.positions) carried.emplace_back(head * glm::dvec4(position, 1));
  return device_->upload(places, std::as_bytes(std::span<const glm::vec4>(carried)));
}

Result<void> StrandMotion::move_character(int frame) {
  if (before_) {
    character_->move_to(std::max(0, frame - 1));
    gpu::Commands commands = device_->record();
    CUTICLE_TRY(character_->record(commands));
    commands.copy(character_->positions(), before_, before_.size());
    CUTICLE_ASSIGN([[maybe_unused]] const gpu::SubmitCost cost, device_->submit(std::move(commands)));
  }
  character_->move_to(frame);
  return measure();
}

Result<void> StrandMotion::measure() {
  if (character_) {
    bounds_ = character_->bounds();
    bounds_ = {bounds_.lower - set_.follow_reach, bounds_.upper + set_.follow_reach};
    return {};
  }
  CUTICLE_ASSIGN(const std::vector<glm::vec4> places,
                 gpu::read_buffer<glm::vec4>(*device_, positions(), set_.control.vertex_count()));
  bounds_ = {glm::vec3(places.front()), glm::vec3(places.front())};
  for (const glm::vec4& place : places) {
    bounds_.lower = glm::min(bounds_.lower, glm::vec3(place));
    bounds_.upper = glm::max(bounds_.upper, glm::vec3(place));
  }
  // Curves through the control vertices may bulge past them, and follow hairs lie beside them.
  const glm::vec3 margin(0.02f * glm::distance(bounds_.lower, bounds_.upper) + 1e-4f + set_.follow_reach);
  bounds_ = {bounds_.lower - margin, bounds_.upper + margin};
  return {};
}

Result<sim::State> StrandMotion::state() {
  if (solver_) return solver_->state();
  if (character_) {
    gpu::Commands commands = device_->record();
    CUTICLE_TRY(character_->record(commands));
    CUTICLE_ASSIGN([[maybe_unused]] const gpu::SubmitCost cost, device_->submit(std::move(commands)));
  }
  CUTICLE_ASSIGN(const std::vector<glm::vec4> places,
                 gpu::read_buffer<glm::vec4>(*device_, positions(), set_.control.vertex_count()));
  sim::State state;
  state.positions.assign(places.begin(), places.end());
  state.velocities.assign(places.size(), glm::vec3(0));
  return state;
}

}  // namespace cuticle::plan
