// What each rung changes of the scene.
#include <algorithm>

#include <fmt/core.h>

#include "bsdf/fibre/fibres.h"
#include "plan/plan.h"
#include "study/picture/picture_study.h"

namespace cuticle::study {
namespace {

using registry::Value;

const registry::Entry* find_pass(std::string_view name) {
  const auto& passes = plan::catalogue().passes;
  const auto found = std::ranges::find(passes, name, &registry::Entry::name);
  return found == passes.end() ? nullptr : *found;
}

void set_pass(scene::Scene& scene, const std::string& pass, const std::string& parameter, Value value) {
  const registry::Entry* entry = find_pass(pass);
  CUTICLE_EXPECT(entry != nullptr, "the ladder names registered passes");
  auto& values = scene.passes.try_emplace(pass, registry::default_values(entry->parameters)).first->second;
  values.set(parameter, std::move(value));
}

/// A rung that sets one parameter of a pass.
Rung sets(std::string name, std::string words, const char* pass, const char* parameter, Value value) {
  return {std::move(name), std::move(words), [=](scene::Scene& scene) -> Result<void> {
            set_pass(scene, pass, parameter, value);
            return {};
          }};
}

/// The model with the physical fibre's parameters.
Rung takes_model(std::string name, std::string words, const std::string& model, const std::string& hair) {
  return {std::move(name), std::move(words), [=](scene::Scene& scene) -> Result<void> {
            CUTICLE_ASSIGN(scene.material.model, model_of_fibre(model, hair));
            return {};
          }};
}

Rung draws(std::string name, std::string words, const std::string& method,
           const std::function<void(scene::Scene&)>& more) {
  return {std::move(name), std::move(words), [=](scene::Scene& scene) -> Result<void> {
            scene.render_method = method;
            more(scene);
            return {};
          }};
}

bool has_parameter(std::string_view pass, std::string_view parameter) {
  const registry::Entry* entry = find_pass(pass);
  return entry != nullptr &&
         std::ranges::find(entry->parameters, parameter, &registry::Parameter::name) != entry->parameters.end();
}

/// So many steps of its solver in a frame.
void set_steps(scene::Scene& scene, int steps) {
  registry::ParameterValues& values = scene.simulation.solver->values;
  values.set("inner_step", 1 / scene.frames_per_second / steps);
  values.set("max_substeps", std::int64_t(steps));
}

/// As the scene itself has its solver step.
Rung simulation_steps(const LadderRequest& request) {
  return {"simulation_steps", "the scene's own steps of " + request.scene.simulation.solver->name,
          [simulation = request.scene.simulation](scene::Scene& scene) -> Result<void> {
            scene.simulation = simulation;
            return {};
          }};
}

Rung path_tracing(const LadderRequest& request) {
  std::string words = fmt::format("every path, {} samples a pixel", request.samples);
  if (is_simulated(request.scene)) words += fmt::format("; hair moved in {} steps a frame", request.reference_steps);
  const Rung model = request.hair.empty() ? Rung{} : takes_model("", "", request.truth_model, request.hair);
  return {"path_tracing", words,
          [model, samples = request.samples, steps = request.reference_steps](scene::Scene& scene) -> Result<void> {
            if (model.apply) CUTICLE_TRY(model.apply(scene));
            if (is_simulated(scene)) set_steps(scene, steps);
            scene.render_method = "reference";
            scene.passes.erase("dual_scattering");
            set_pass(scene, "reference", "samples", std::int64_t(samples));
            return {};
          }};
}

/// Slices of the tiles' depth and fewer shading points; strands and pixels are left out by the passes' own defaults.
void add_level_of_detail(scene::Scene& scene) {
  scene.passes.erase("tile_lists");
  set_pass(scene, "shade_strands", "point_px", 8.0);
  set_pass(scene, "tile_sort", "slices", std::int64_t(32));
}

}  // namespace

Result<scene::Block> model_of_fibre(const std::string& model, const std::string& hair) {
  CUTICLE_ASSIGN(const bsdf::Model* found, bsdf::find_model(model));
  CUTICLE_ASSIGN(bsdf::NamedFibre named, bsdf::find_fibre(hair));
  if (!found->from_fibre)
    return usage_error(fmt::format("model {} takes no physical fibre", model), "chiang, marschner");
  named.fibre.aspect = 1;
  CUTICLE_ASSIGN(auto values, bsdf::parse_settings(*found, "", found->from_fibre(named.fibre).settings));
  return scene::Block{model, std::move(values)};
}

Result<std::vector<Rung>> rungs_of(const LadderRequest& request) {
  std::vector<Rung> rungs = {path_tracing(request)};
  rungs.push_back(sets("far_field", "the mean over the fibre's width", "reference", "field", std::string("far")));
  if (!request.hair.empty() && request.model != request.truth_model)
    rungs.push_back(takes_model("model", fmt::format("{} in the place of {}", request.model, request.truth_model),
                                request.model, request.hair));
  if (has_parameter("reference", "tables"))
    rungs.push_back(sets("tables", "lookup tables in the place of the model", "reference", "tables", true));
  rungs.push_back(sets("single_scattering", "direct light alone", "reference", "bounces", std::int64_t(1)));
  if (has_parameter("reference", "shadow") && request.scene.shadow)
    rungs.push_back(sets("shadow_method", request.scene.shadow->name + " in the place of shadow rays", "reference",
                         "shadow", request.scene.shadow->name));
  rungs.push_back(draws("strand_space", "shaded at the vertices; coverage by brute force", "supersampled",
                        [samples = request.truth_coverage](scene::Scene& scene) {
                          set_pass(scene, "supersampled", "samples", std::int64_t(samples));
                        }));
  if (request.scene.passes.contains("dual_scattering"))
    rungs.push_back(
        {"dual_scattering", "an estimate of the light that scatters more than once",
         [values = request.scene.passes.find("dual_scattering")->second](scene::Scene& scene) -> Result<void> {
           scene.passes.insert_or_assign("dual_scattering", values);
           return {};
         }});
  rungs.push_back(draws("coverage", "tiles with rows of samples", "tiles",
                        [](scene::Scene& scene) { set_pass(scene, "tile_lists", "full_px", 0.0); }));
  rungs.push_back({"level_of_detail",
                   "a shading point each 8 pixels, 32 slices of depth, fewer strands where they are small",
                   [](scene::Scene& scene) -> Result<void> {
                     add_level_of_detail(scene);
                     return {};
                   }});
  if (is_simulated(request.scene)) rungs.push_back(simulation_steps(request));
  for (const std::string& name : request.without)
    if (std::ranges::find(rungs, name, &Rung::name) == rungs.end())
      return usage_error(fmt::format("--without: '{}' is no rung of this ladder", name),
                         "tables, level_of_detail, ...");
  return rungs;
}

}  // namespace cuticle::study
