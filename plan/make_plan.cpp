#include <algorithm>

#include <fmt/core.h>

#include "plan/frame_graph.h"
#include "plan/opacity_runs.h"
#include "plan/plan.h"
#include "render/frame.h"
#include "render/pass.h"
#include "render/passes/aovs/aovs.h"
#include "render/passes/velocity/velocity.h"
#include "sim/solver.h"

namespace cuticle::plan {

namespace {

using registry::Entry;
using registry::ParameterValues;

/// One entry that could run: its parameters here, and why it is not the scene's choice (empty: it is).
struct Candidate {
  const Entry* entry;
  ParameterValues values;
  std::string not_chosen;
  bool fused = false;                  ///< its work is in the solver's dispatches
  std::uint32_t runs = 1, powers = 0;  ///< of a shadow method, and of what it left of one opacity, for each light
};

ParameterValues values_in(const std::map<std::string, ParameterValues, std::less<>>& blocks, const Entry& entry) {
  const auto found = blocks.find(entry.name);
  return found == blocks.end() ? registry::default_values(entry.parameters) : found->second;
}

/// A candidate of which the scene names one: shadow methods, solvers.
Candidate one_of(const Entry& entry, const std::optional<scene::Block>& chosen, std::string_view what) {
  if (chosen && chosen->name == entry.name) return {&entry, chosen->values, ""};
  return {
      &entry,
      {},
      chosen ? fmt::format("the scene's {} is '{}'", what, chosen->name) : fmt::format("the scene names no {}", what)};
}

/// Whether the scene's solver does the work of this effect in its own dispatches.
bool is_fused(const scene::Scene& scene, const Entry& entry) {
  if (!scene.simulation.solver) return false;
  const auto solver = sim::find_effect(scene.simulation.solver->name), effect = sim::find_effect(entry.name);
  return solver && effect && (*solver)->fuses_effects && !(*effect)->acts_on_result;
}

std::vector<Candidate> candidates(const scene::Scene& scene) {
  std::vector<Candidate> all;
  for (const Entry* entry : catalogue().solvers) all.push_back(one_of(*entry, scene.simulation.solver, "solver"));
  for (const Entry* entry : catalogue().effects)
    all.push_back({entry, values_in(scene.simulation.effects, *entry), "", is_fused(scene, *entry)});
  for (const Entry* entry : catalogue().methods) {
    all.push_back(one_of(*entry, scene.shadow, "shadow method"));
    if (!all.back().not_chosen.empty()) continue;
    const OpacityRuns runs = opacity_runs(scene);
    all.back().runs = runs.runs;
    all.back().powers = runs.powers;
  }
  for (const Entry* entry : catalogue().passes) all.push_back({entry, values_in(scene.passes, *entry), ""});
  return all;
}

std::uint32_t dispatches_of(const Candidate& candidate, const registry::FrameShape& shape) {
  const auto count = candidate.entry->dispatches;
  return count && !candidate.fused ? candidate.runs * count(candidate.values, shape) + candidate.powers * shape.lights
                                   : 0;
}

/// What a pass dispatches to ask the fibre model by its formulas.
std::uint32_t formula_dispatches(const scene::Scene& scene, const Entry& entry, const registry::FrameShape& shape) {
  const render::Pass* const pass = render::pass_of(entry);
  return pass && pass->asks_model && scene.material.evaluate == "direct" ? render::k_formula_dispatches * shape.lights
                                                                         : 0;
}

/// Whether the CPU's code moves the hair in place of the device's kernels.
registry::Fact solved_on_cpu(const scene::Scene& scene, const DeviceTraits& device) {
  if (!scene.simulation.solver) return {false, "the hair is not simulated"};
  if (scene.simulation.solve_on == "cpu") return {true, "on the CPU, as the scene asks"};
  if (scene.simulation.solve_on == "device") return {false, "on the device, as the scene asks"};
  if (device.is_software)
    return {true, device.name.empty()
                      ? "on the CPU: there is no device"
                      : fmt::format("on the CPU: {} has no GPU, kernels take longer there", device.name)};
  return {false, "on the device"};
}

/// What the scene asks for of a frame.
std::vector<std::string_view> outputs_of(const scene::Scene& scene) {
  using namespace render;
  std::vector<std::string_view> outputs;
  if (scene.simulation.solver) outputs.push_back(name_of<ControlHairs>());
  if (!scene.outputs.color) return outputs;
  outputs.push_back(name_of<Output>());
  if (scene.render_method == "reference") return outputs;
  const bool moves = scene.passes.contains("velocity");
  if (scene.outputs.aovs || moves) outputs.push_back(name_of<aovs::Layers>());
  if (moves) outputs.insert(outputs.end(), {name_of<velocity::MotionVectors>(), name_of<SeenVelocities>()});
  return outputs;
}

}  // namespace

Plan make_plan(const scene::Scene& scene, const registry::FrameShape& shape, const DeviceTraits& device) {
  Plan plan{facts_of(scene), shape, {}, {}};
  const registry::Fact on_cpu = plan.facts["solved_on_cpu"] = solved_on_cpu(scene, device);
  for (const Candidate& candidate : candidates(scene)) {
    const Entry& entry = *candidate.entry;
    const registry::Verdict verdict = registry::judge(entry, plan.facts);
    const std::string& refused = verdict.demanded ? candidate.not_chosen : verdict.reason;
    if (!refused.empty())
      plan.left_out.push_back({&entry, refused});
    else
      plan.passes.push_back(on_cpu.holds && entry.stage == registry::Stage::simulate
                                ? PlannedPass{&entry, verdict.reason + "; " + on_cpu.why, 0, 0, true}
                                : PlannedPass{&entry, verdict.reason,
                                              dispatches_of(candidate, shape) + formula_dispatches(scene, entry, shape),
                                              entry.draws});
  }
  plan.outputs = outputs_of(scene);
  compile(plan);
  return plan;
}

const PlannedPass* find_pass(const Plan& plan, std::string_view name) {
  const auto found =
      std::ranges::find_if(plan.passes, [&](const PlannedPass& pass) { return pass.entry->name == name; });
  return found == plan.passes.end() ? nullptr : &*found;
}

}  // namespace cuticle::plan
