#include <algorithm>

#include <fmt/core.h>

#include "bsdf/fibre/fibres.h"
#include "plan/plan.h"
#include "study/models/models_study.h"
#include "study/picture/picture_study.h"
#include "study/registry/entries.h"

namespace cuticle::study {
namespace {

constexpr const char* k_truth_model = "huang";

/// The ladder's scene, path traced with a model.
Result<RungPicture> traced(const std::shared_ptr<gpu::Device>& device, LadderRequest request, const std::string& model, bool tables, Progress& progress) {
  request.name = fmt::format("picture with {}", model);
  request.truth_model = request.model = model;
  CUTICLE_ASSIGN(std::vector<Rung> rungs, rungs_of(request));
  std::erase_if(rungs, [&](const Rung& rung) { return rung.name != "path_tracing" && !(tables && (rung.name == "far_field" || rung.name == "tables")); });
  CUTICLE_ASSIGN(Ladder ladder, climb(device, rungs, request, progress));
  return std::move(ladder.rungs.back());
}

Point point_of(const std::string& model, const char* evaluate, const RungPicture& picture, const Image& truth) {
  const Measured measured{{squared_errors(truth, picture.color, truth)}};
  return {model, {{"evaluate", evaluate}}, [measured]() -> Result<Measured> { return measured; }, {}, picture.seconds};
}

Result<Group> pictures_of(const StudyRequest& request, const std::shared_ptr<gpu::Device>& device, Study& study, Progress& progress) {
  LadderRequest ladder;
  CUTICLE_ASSIGN(ladder.scene, scene::load_scene(request.share + "/scenes/ladder/blond.json", plan::catalogue()));
  ladder.scene.camera.camera.resolution /= request.quick ? 4 : 1;
  ladder.hair = request.options.at("hair");
  ladder.samples = request.quick ? 8 : 128;
  CUTICLE_ASSIGN(const RungPicture truth, traced(device, ladder, k_truth_model, false, progress));
  Group group{.name = "picture",
              .title = "Path tracing with every model",
              .truth = fmt::format("path tracing with {}, {} samples a pixel", k_truth_model, ladder.samples),
              .metrics = {{"picture", "relative MSE of the picture"}},
              .item = "pixel"};
  study.pictures.push_back({"truth.png", k_truth_model, "", tone_map(truth.color, ladder.scene.outputs.exposure_stops)});
  for (const bsdf::Model* model : bsdf::models()) {
    const std::string name(model->entry.name);
    if (!model->from_fibre || name == k_truth_model) continue;
    for (const bool tables : {false, true}) {
      const auto picture = traced(device, ladder, name, tables, progress);
      if (!picture) {
        study.notes.push_back(fmt::format("No picture with {}{}: {}", name, tables ? " by tables" : "", picture.error().message));
        continue;
      }
      group.points.push_back(point_of(name, tables ? "tables" : "direct", *picture, truth.color));
      study.pictures.push_back({fmt::format("{}{}.png", name, tables ? "_tables" : ""), fmt::format("{}{}", name, tables ? ", tables" : ""), "truth.png",
                                tone_map(picture->color, ladder.scene.outputs.exposure_stops)});
    }
  }
  return group;
}

Result<Study> declare_models(const StudyRequest& request, Progress& progress) {
  ModelsRequest models;
  CUTICLE_ASSIGN(const bsdf::NamedFibre hair, bsdf::find_fibre(request.options.at("hair")));
  models.fibre = hair.fibre;
  if (request.quick) {
    models.walks = 20000;
    models.thetas = 9;
    models.phis = 12;
    models.inner = 2;
  }
  Study study{.name = "models",
              .title = fmt::format("All models on {} hair under one truth", request.options.at("hair")),
              .question = "How far is each fibre model from light walked through a fibre, and from the picture of the microfacet model?",
              .cost_label = "one evaluation of S (lobes), one picture (picture)"};
  CUTICLE_ASSIGN(Group lobes, models_against_walks(models, study.notes, progress));
  study.groups.push_back(std::move(lobes));
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = request.device}));
  study.device = device->info().name;
  study.driver = device->info().driver;
  CUTICLE_ASSIGN(Group pictures, pictures_of(request, device, study, progress));
  study.groups.push_back(std::move(pictures));
  return study;
}

}  // namespace

const StudyEntry& models_entry() {
  static const StudyEntry entry{.name = "models",
                                .summary = "all models under one truth: lobes against a Monte Carlo walk, pictures against path tracing",
                                .options = {{"hair", "blond", "physical fibre that every model is mapped to"}},
                                .declare = declare_models,
                                .quick_seconds = 40,
                                .seconds = 900};
  return entry;
}

}  // namespace cuticle::study
