#include "plan/strand_motion_gpu.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/content_key.h"
#include "plan/frame_cost_gpu.h"
#include "plan/simulation.h"
#include "sim/colliders/contact.h"
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
  if (scene.simulation.effects.contains("control"))
    return usage_error("simulation: hair on a character's skin cannot have the effect 'control'", "leave it out");
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
    CUTICLE_ASSIGN(motion->carried_,
                   motion->device_->make_texel_buffer(set.control.vertex_count() * sizeof(glm::vec4)));
  }
  if (!set.fins.triangles.empty()) {
    CUTICLE_ASSIGN(motion->fins_, FinMotion::create(motion->device_, scene, set, plan));
  }
  motion->hands_over_motion_ = find_pass(plan, "velocity") != nullptr;
  if (motion->hands_over_motion_ && !scene.simulation.solver) {
    CUTICLE_ASSIGN(motion->before_, motion->device_->make_texel_buffer(set.control.vertex_count() * sizeof(glm::vec4)));
  }
  return motion;
}

const gpu::Buffer& StrandMotion::positions() const {
  if (host_) return host_->positions();
  if (solver_) return solver_->positions();
  return character_ ? character_->positions() : carried_;
}

strands::ControlMotion StrandMotion::control_motion() const {
  if (!hands_over_motion_) return {};
  if (host_) return {&host_->velocities(), 0};
  if (solver_) return {&solver_->velocities(), 0};
  return {&before_, float(1 / scene_.frames_per_second)};
}

Result<void> StrandMotion::restart() {
  frame_ = -1;
  all_sleep_ = overreached_ = false;
  if (!scene_.simulation.solver) return {};
  const scene::Block& block = *scene_.simulation.solver;
  const sim::EffectBlocks effects = planned_effects(scene_, plan_);
  if (plan_.facts.at("solved_on_cpu").holds) {
    CUTICLE_ASSIGN(auto solver, make_cpu_solver(scene_, set_, plan_));
    CUTICLE_ASSIGN(host_, HostSolver::create(device_, std::move(solver), block.name, set_.control.vertex_count()));
  } else {
    CUTICLE_ASSIGN(const sim::GpuEffect* effect, sim::find_gpu_effect(block.name));
    CUTICLE_ASSIGN(solver_, effect->create(device_, set_.control, block.values, effects));
    if (const auto control = sim::find_effect<sim::control::Control>(effects)) {
      CUTICLE_ASSIGN(solver_, sim::control::controlled_gpu(device_, std::move(solver_), set_.control, *control));
    }
  }
  if (fins_) CUTICLE_TRY(fins_->restart(effects));
  // On a skin no rest space tells what is near.
  const auto contact = sim::find_effect<sim::colliders::ContactSettings>(effects);
  balls_.clear();
  if (contact && !character_) balls_ = reach_balls(set_.control, double(contact->pearl_radius));
  return settle();
}

Result<void> StrandMotion::settle() {
  const int frames = int(std::ceil(scene_.simulation.settle_time * scene_.frames_per_second));
  for (int k = 0; k < frames; ++k) CUTICLE_TRY(simulate(0, nullptr));
  return {};
}

/// Colliders that cannot come near any strand in this frame: the frame's contacts, and nothing else, fall away; else
/// those of the strands that none comes near. The first frame has all, so that a solver says which it does
/// not meet. Where strands sleep, those that nothing comes near sleep on, so that the solver has to know them always.
void StrandMotion::leave_out_far_colliders(sim::FrameInput& input) {
  const bool collides = find_pass(plan_, "colliders") != nullptr;
  in_reach_ = {collides, collides ? "colliders are met in every frame" : "the scene has no collisions"};
  const bool sleeps = find_pass(plan_, "sleep") != nullptr;
  was_near_ = std::exchange(near_, true);
  if (balls_.empty() || frame_ < 0 || overreached_ || (everything_ && !sleeps)) return;
  reached_ = hairs_in_reach(balls_, input, plan_.shape.substeps);
  const auto count = std::ranges::count(reached_, 1);
  in_reach_ = {count > 0, fmt::format("{} of {} control hairs are within reach of a collider", count, reached_.size())};
  near_ = count > 0;
  if (near_ || sleeps) {
    input.reached = reached_;
    return;
  }
  input.colliders = {};
  input.boxes = {};
  input.fields = {};
  input.moving = {};
}

/// Whether nothing would change: all strands sleep, and nothing acts on them that did not in the frame before. A
/// collider that moves wakes nothing where it comes near no strand.
bool StrandMotion::rests(const sim::FrameInput& input) const {
  if (everything_ || !all_sleep_ || frame_ < 0 || character_ || fins_) return false;
  const auto still = [&](const sim::MovingCollider& moving) {
    return moving.motion.rests(input.clock_begin, input.clock_end);
  };
  const bool pushed = find_pass(plan_, "wind") || find_pass(plan_, "water") || find_pass(plan_, "control");
  return !pushed && input.head_begin == input.head_end &&
         ((!near_ && !was_near_) || std::ranges::all_of(input.moving, still));
}

Result<void> StrandMotion::count_sleepers() {
  if (!find_pass(plan_, "sleep")) return {};
  if (host_) {
    all_sleep_ = host_->state().asleep == set_.control.strand_count();
    return {};
  }
  CUTICLE_ASSIGN(const sim::State now, solver_->state());
  all_sleep_ = now.asleep == set_.control.strand_count();
  return {};
}

Result<gpu::SubmitCost> StrandMotion::simulate(int frame, Trace* trace) {
  sim::FrameInput input = input_of(scene_, set_, plan_, path_, frame);
  leave_out_far_colliders(input);
  if (rests(input)) {
    awake_ = {false, "every strand sleeps, and nothing acts on hair anew"};
    return gpu::SubmitCost{};
  }
  awake_ = {true, "hair moves"};
  if (fins_) CUTICLE_TRY(fins_->advance(input));
  if (host_) return simulate_on_cpu(std::move(input), frame, trace);
  gpu::Commands commands = device_->record();
  if (character_) {
    character_->move_to(frame);
    CUTICLE_TRY(character_->record(commands));
    CUTICLE_TRY(solver_->record_on_skin(commands, input, character_->positions()));
  } else {
    CUTICLE_TRY(solver_->record(commands, input));
  }
  CUTICLE_ASSIGN(gpu::SubmitCost cost, device_->submit(std::move(commands), trace));
  CUTICLE_TRY(count_sleepers());
  return cost;
}

/// A character's skin is moved on the device first, and its places come back.
Result<gpu::SubmitCost> StrandMotion::simulate_on_cpu(sim::FrameInput input, int frame, Trace* trace) {
  gpu::SubmitCost cost;
  std::vector<glm::vec3> skinned;
  if (character_) {
    character_->move_to(frame);
    gpu::Commands commands = device_->record();
    CUTICLE_TRY(character_->record(commands));
    CUTICLE_ASSIGN(cost, device_->submit(std::move(commands), trace));
    CUTICLE_ASSIGN(const std::vector<glm::vec4> places,
                   gpu::read_buffer<glm::vec4>(*device_, character_->positions(), set_.control.vertex_count()));
    skinned.assign(places.begin(), places.end());
    input.skinned = skinned;
  }
  CUTICLE_ASSIGN(const gpu::SubmitCost more, host_->advance(input));
  add_cost(more, cost);
  CUTICLE_TRY(count_sleepers());
  return cost;
}

Result<gpu::SubmitCost> StrandMotion::advance_to(int frame, Trace* trace, bool everything) {
  everything_ = everything;
  const bool simulated = scene_.simulation.solver.has_value();
  if (character_ && !simulated) {
    frame_ = frame;
    CUTICLE_TRY(move_character(frame));
    return gpu::SubmitCost{};
  }
  gpu::SubmitCost cost;
  if (frame_ < 0 || frame < frame_) CUTICLE_TRY(restart());
  for (int next = simulated ? frame_ + 1 : frame; next <= frame; ++next) {
    head_ = path_.at(next);
    if (!simulated) break;
    CUTICLE_ASSIGN(cost, simulate(next, trace));
    frame_ = next;
  }
  frame_ = frame;
  if (!simulated) CUTICLE_TRY(carry_rigidly(frame));
  CUTICLE_TRY(measure());
  return cost;
}

std::vector<sim::PlacedCollider> StrandMotion::colliders() const {
  sim::FrameInput input = input_of(scene_, set_, plan_, path_, std::max(0, frame_));
  if (character_) input.head_end = glm::dmat4(1);
  return sim::placed_colliders(input);
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

/// Where the control hairs are, world.
Result<std::vector<glm::vec4>> StrandMotion::places() {
  if (!host_) return gpu::read_buffer<glm::vec4>(*device_, positions(), set_.control.vertex_count());
  std::vector<glm::vec4> places;
  for (const glm::vec3& position : host_->state().positions) places.emplace_back(position, 1);
  return places;
}

/// Where hair on a character is, the device alone knows: its frame stands for it.
void StrandMotion::set_keys(std::span<const glm::vec4> places) {
  ContentKey hair, surfaces;
  hair.add(places);
  hair.add(head_);
  surfaces.add(head_);
  const bool poses = character_ && (scene_.simulation.solver || !scene_.character->clip.empty());
  const bool drifts = hands_over_motion_ && scene_.simulation.solver;
  if (poses || drifts) hair.add(frame_);
  if (hands_over_motion_) hair.add(path_.at(std::max(0, frame_ - 1)));
  if (poses) surfaces.add(frame_);
  if (fins_) surfaces.add(std::span<const glm::vec3>(fins_->mesh().positions));
  hair_key_ = hair.value();
  surfaces_key_ = surfaces.value();
}

Result<void> StrandMotion::measure() {
  if (character_) {
    bounds_ = character_->bounds();
    bounds_ = {bounds_.lower - set_.follow_reach, bounds_.upper + set_.follow_reach};
    set_keys({});
    return {};
  }
  CUTICLE_ASSIGN(const std::vector<glm::vec4> places, this->places());
  set_keys(places);
  bounds_ = {glm::vec3(places.front()), glm::vec3(places.front())};
  for (const glm::vec4& place : places) {
    bounds_.lower = glm::min(bounds_.lower, glm::vec3(place));
    bounds_.upper = glm::max(bounds_.upper, glm::vec3(place));
  }
  // Curves through the control vertices may bulge past them, and follow hairs lie beside them.
  const glm::vec3 margin(0.02f * glm::distance(bounds_.lower, bounds_.upper) + 1e-4f + set_.follow_reach);
  bounds_ = {bounds_.lower - margin, bounds_.upper + margin};
  overreached_ = overreached_ || !within_reach(balls_, set_.control, places, head_);
  return {};
}

Result<sim::State> StrandMotion::state() {
  if (host_) return host_->state();
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
