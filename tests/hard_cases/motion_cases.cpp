// Every solver, or those of "solvers", one after the other: {"groom", "solver": {name: settings}, "effects": {name: settings}, "colliders":
// [[x, y, z, radius]], "frames", "measure"}. A frame: {"duration", "turn_deg" about y, "move", "teleport", "repeat"}.
// Measures: "stretch", "head_distance", "speed".
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/json/json.h"
#include "sim/solver.h"
#include "tests/hard_cases/subject.h"
#ifdef CUTICLE_HAS_GPU
#include "sim/solver_gpu.h"
#include "tests/hard_cases/gpu_session.h"
#endif

namespace cuticle::hard_cases {
namespace {

struct Setting {
  strands::Groom groom;
  registry::ParameterValues solver;
  sim::EffectBlocks effects;
};

Result<registry::ParameterValues> values_of(const std::string& effect, const std::string& settings) {
  CUTICLE_ASSIGN(const sim::Effect* entry, sim::find_effect(effect));
  return registry::parse_assignments(entry->entry.parameters, settings);
}

/// Not every effect acts on every solver.
std::vector<std::string> solvers_of(const Json& inputs) {
  std::vector<std::string> names;
  for (const Json& name : inputs.value("solvers", Json::list({"classic", "exact", "rod"}))) names.push_back(name.text());
  return names;
}

Result<Setting> setting_from(const Json& inputs, std::string_view solver) {
  Setting setting;
  setting.groom = groom_from(inputs.at("groom"));
  const std::string name(solver), settings = inputs.value("solver", Json::object()).value(name, std::string());
  CUTICLE_ASSIGN(setting.solver, values_of(name, settings));
  const Json effects = inputs.value("effects", Json::object());
  for (const auto& [effect, values] : effects.items()) {
    CUTICLE_ASSIGN(setting.effects[effect], values_of(effect, values.text()));
  }
  return setting;
}

std::vector<Sphere> spheres(const Json& inputs) {
  std::vector<Sphere> list;
  for (const Json& sphere : inputs.value("colliders", Json::list()))
    list.push_back({vector(sphere), sphere.at(3).number()});
  return list;
}

glm::dmat4 moved(const glm::dmat4& head, const Json& frame) {
  const glm::dvec3 move = frame.contains("move") ? vector(frame.at("move")) : glm::dvec3(0);
  const double turn = frame.value("turn_deg", 0.0) * std::numbers::pi / 180;
  return glm::rotate(glm::translate(glm::dmat4(1), move) * head, turn, glm::dvec3(0, 1, 0));
}

/// Runs the frames; gives the head's last place.
Result<glm::dvec3> run_frames(sim::Solver& solver, const Json& inputs) {
  const std::vector<Sphere> colliders = spheres(inputs);
  glm::dmat4 head(1);
  for (const Json& frame : inputs.at("frames"))
    for (int k = 0; k < frame.value("repeat", 1); ++k) {
      const glm::dmat4 next = moved(head, frame);
      CUTICLE_TRY(solver.advance({.duration = frame.value("duration", 1.0 / 60),
                                  .head_begin = head,
                                  .head_end = next,
                                  .colliders = colliders,
                                  .teleport = frame.value("teleport", false)}));
      head = next;
    }
  return glm::dvec3(head[3]);
}

Values measured(const std::string& measure, const strands::Groom& rest, const sim::State& state, glm::dvec3 head) {
  Values values;
  if (measure == "stretch")
    for (float ratio : sim::stretch(rest, state.positions)) values.push_back(double(ratio));
  if (measure == "head_distance")
    for (const glm::vec3& position : state.positions) values.push_back(glm::distance(glm::dvec3(position), head));
  if (measure == "speed")
    for (const glm::vec3& velocity : state.velocities) values.push_back(glm::length(glm::dvec3(velocity)));
  return values;
}

Result<void> run(sim::Solver& solver, const strands::Groom& rest, const Json& inputs, Values& values) {
  CUTICLE_ASSIGN(const glm::dvec3 head, run_frames(solver, inputs));
  CUTICLE_ASSIGN(const sim::State state, solver.state());
  const Values more = measured(inputs.at("measure").text(), rest, state, head);
  values.insert(values.end(), more.begin(), more.end());
  return {};
}

}  // namespace

Result<Values> run_motion_f32(const Json& inputs, GpuSession*) {
  Values values;
  for (const std::string& name : solvers_of(inputs)) {
    CUTICLE_ASSIGN(const Setting setting, setting_from(inputs, name));
    CUTICLE_ASSIGN(const sim::Effect* effect, sim::find_effect(name));
    CUTICLE_ASSIGN(const std::unique_ptr<sim::Solver> solver,
                   effect->create(setting.groom, setting.solver, setting.effects));
    CUTICLE_TRY(run(*solver, setting.groom, inputs, values));
  }
  return values;
}

#ifdef CUTICLE_HAS_GPU
Result<Values> run_motion_gpu(const Json& inputs, GpuSession* session) {
  Values values;
  for (const std::string& name : solvers_of(inputs)) {
    CUTICLE_ASSIGN(const Setting setting, setting_from(inputs, name));
    CUTICLE_ASSIGN(const sim::GpuEffect* effect, sim::find_gpu_effect(name));
    CUTICLE_ASSIGN(const std::unique_ptr<sim::GpuSolver> solver,
                   effect->create(session->device, setting.groom, setting.solver, setting.effects));
    CUTICLE_TRY(run(*solver, setting.groom, inputs, values));
  }
  return values;
}
#endif

}  // namespace cuticle::hard_cases
