#include <fmt/core.h>

#include "plan/plan.h"
#include "study/models/models_study.h"
#include "study/registry/entries.h"

namespace cuticle::study {
namespace {

Result<Study> declare_models(const StudyRequest& request, Progress& progress) {
  ModelsRequest models;
  LadderRequest& ladder = models.ladder;
  ladder.name = "models";
  const std::string& scene = request.options.at("scene");
  CUTICLE_ASSIGN(ladder.scene, scene::load_scene(scene.empty() ? request.share + "/scenes/ladder/blond.json" : scene,
                                                 plan::catalogue()));
  ladder.scene.simulation = {};
  ladder.hair = request.options.at("hair");
  ladder.truth_model = request.options.at("truth-model");
  ladder.samples = 64;
  if (request.quick) {
    ladder.scene.camera.camera.resolution = ladder.scene.camera.camera.resolution / 8;
    ladder.samples = 8;
    ladder.batches = 8;  // as many as paths: the least noise
    models.table_size = 24;
  }
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = request.device}));
  return models_study(device, models, progress);
}

}  // namespace

const StudyEntry& models_entry() {
  static const StudyEntry entry{.name = "models",
                                .summary =
                                    "all models of one physical fibre in one path-traced picture: error and time, by "
                                    "direct evaluation and by tables",
                                .options = {{"scene", "", "scene file; without it the ladder's long hair", true},
                                            {"hair", "brown", "physical fibre of all models"},
                                            {"truth-model", "huang", "model of the truth"}},
                                .declare = declare_models,
                                .quick_seconds = 29,
                                .seconds = 600};
  return entry;
}

}  // namespace cuticle::study
