#include "plan/simulation.h"

#include <algorithm>

#include "sim/control/control.h"

namespace cuticle::plan {

sim::EffectBlocks planned_effects(const scene::Scene& scene, const Plan& plan) {
  sim::EffectBlocks blocks;
  for (const registry::Entry* effect : catalogue().effects) {
    if (!find_pass(plan, effect->name) || (*sim::find_effect(effect->name))->acts_on_fins) continue;
    const auto given = scene.simulation.effects.find(effect->name);
    blocks[std::string(effect->name)] =
        given == scene.simulation.effects.end() ? registry::default_values(effect->parameters) : given->second;
  }
  return blocks;
}

Result<std::unique_ptr<sim::Solver>> make_cpu_solver(const scene::Scene& scene, const StrandSet& set,
                                                     const Plan& plan) {
  const scene::Block& block = *scene.simulation.solver;
  CUTICLE_ASSIGN(const sim::Effect* effect, sim::find_effect(block.name));
  const sim::EffectBlocks effects = planned_effects(scene, plan);
  CUTICLE_ASSIGN(auto solver, effect->create(set.control, block.values, effects));
  if (const auto control = sim::find_effect<sim::control::Control>(effects))
    solver = sim::control::controlled(std::move(solver), set.control, *control);
  return solver;
}

sim::FrameInput input_of(const scene::Scene& scene, const StrandSet& set, const Plan& plan, const HeadPath& path,
                         int frame) {
  const bool collides = find_pass(plan, "colliders") != nullptr;
  const int before = std::max(0, frame - 1);
  return {.duration = 1 / scene.frames_per_second,
          .head_begin = path.at(before),
          .head_end = path.at(frame),
          .colliders = collides ? set.colliders : std::span<const Sphere>(),
          .boxes = collides ? set.boxes : std::span<const RoundedBox>(),
          .fields = collides ? set.fields : std::span<const sim::FieldPointer>(),
          .moving = collides ? set.moving : std::span<const sim::MovingCollider>(),
          .clock_begin = before / scene.frames_per_second,
          .clock_end = frame / scene.frames_per_second};
}

}  // namespace cuticle::plan
