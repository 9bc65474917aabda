#include "study/models/models_study.h"

#include <algorithm>

#include <fmt/core.h>

#include "bsdf/model.h"
#include "plan/plan.h"
#include "study/picture/shown_picture.h"

namespace cuticle::study {
namespace {

/// What path traces: a model, near field where it has one, or its tables.
struct Subject {
  std::string model;
  bool tables = false;
};

std::vector<Subject> subjects(const LadderRequest& request, std::vector<std::string>& notes) {
  std::vector<Subject> all = {{request.truth_model, false}};
  for (const bsdf::Model* model : bsdf::models()) {
    const std::string name(model->entry.name);
    if (model->from_fibre == nullptr || model->sample_f32 == nullptr) {
      notes.push_back(fmt::format("{}: left out, it takes no physical fibre or draws no directions", name));
      continue;
    }
    if (name != request.truth_model) all.push_back({name, false});
    all.push_back({name, true});
  }
  return all;
}

Result<void> apply(const Subject& subject, const ModelsRequest& request, scene::Scene& scene) {
  CUTICLE_ASSIGN(scene::Block model, model_of_fibre(subject.model, request.ladder.hair));
  // Lobes of a model that walks are no products, and a texel of M or N takes as long as thousands of S.
  CUTICLE_ASSIGN(const bsdf::Model* registered, bsdf::find_model(subject.model));
  const char* layout = registered->scattering_from_viewer != nullptr ? "factored" : "nalu_theta";
  scene.material = {.model = std::move(model), .layout = layout, .lut_size = request.table_size};
  scene.render_method = "reference";
  scene.passes.erase("dual_scattering");
  const auto& passes = plan::catalogue().passes;
  const auto reference = std::ranges::find(passes, "reference", &registry::Entry::name);
  CUTICLE_EXPECT(reference != passes.end(), "the study names registered passes");
  registry::ParameterValues& paths =
      scene.passes.try_emplace("reference", registry::default_values((*reference)->parameters)).first->second;
  paths.set("field", std::string(subject.tables ? "far" : "near"));
  paths.set("tables", subject.tables);
  paths.set("samples", std::int64_t(request.ladder.samples));
  return {};
}

struct Drawn {
  Subject subject;
  RungPicture picture;
};

Result<std::vector<Drawn>> draw_all(Stage& stage, const ModelsRequest& request, Study& study, Progress& progress) {
  std::vector<Drawn> drawn;
  const std::vector<Subject> all = subjects(request.ladder, study.notes);
  for (std::size_t k = 0; k < all.size(); ++k) {
    progress.update("models in the picture", k, all.size());
    scene::Scene scene = hair_of(request.ladder.scene);
    CUTICLE_TRY(apply(all[k], request, scene));
    auto picture = stage.draw({all[k].model, {}, {}}, scene);
    if (picture)
      drawn.push_back({all[k], std::move(picture).value()});
    else if (k == 0)
      return picture.error();
    else
      study.notes.push_back(
          fmt::format("{}{}: {}", all[k].model, all[k].tables ? " by tables" : "", picture.error().message));
  }
  progress.update("models in the picture", all.size(), all.size());
  return drawn;
}

void add_picture(Study& study, const Drawn& drawn, const Image& color, const std::string& truth, double exposure) {
  const std::string how = drawn.subject.tables ? "tables" : "direct";
  study.pictures.push_back({fmt::format("{}_{}.png", drawn.subject.model, how),
                            fmt::format("{}, {}", drawn.subject.model, how), truth, tone_map(color, exposure)});
}

}  // namespace

Result<Study> models_study(std::shared_ptr<gpu::Device> device, const ModelsRequest& request, Progress& progress) {
  Study study{
      .name = "models",
      .title = fmt::format("All models in one picture, against path tracing with {}", request.ladder.truth_model),
      .question = "What does the choice of a model change in the final picture, by direct evaluation and by tables?",
      .cost_label = "path tracing the picture",
      .wall_clock = !device->info().is_software};
  Stage stage(device, request.ladder, progress);
  CUTICLE_ASSIGN(const std::vector<Drawn> drawn, draw_all(stage, request, study, progress));
  std::vector<const NoisyPicture*> pictures;
  for (const Drawn& each : drawn) pictures.push_back(&each.picture.picture);
  const RelativeSquares squares(pictures);
  const NoisyPicture& truth = drawn.front().picture.picture;
  Group group{.name = "picture",
              .title = study.title,
              .truth = fmt::format("{} by direct evaluation, {} paths a pixel, the fibre {}",
                                   request.ladder.truth_model, request.ladder.samples, request.ladder.hair),
              .metrics = {{"light", "relative MSE of the light of 8 x 8 pixels", "1", Mean::squares},
                          {"picture", "relative MSE of the picture", "1", Mean::squares}},
              .item = "tile of 8 x 8 pixels"};
  const double exposure = request.ladder.scene.outputs.exposure_stops;
  const std::string first = fmt::format("{}_direct.png", request.ladder.truth_model);
  for (const Drawn& each : drawn) {
    const bool is_truth = &each == &drawn.front();
    add_picture(study, each, shown_picture(each.picture.picture), is_truth ? "" : first, exposure);
    if (is_truth) continue;
    Measured measured{{squares.light(truth, each.picture.picture), squares.tiles(truth, each.picture.picture)}, 0};
    group.points.push_back({each.subject.model,
                            {{"evaluate", each.subject.tables ? "tables" : "direct"}},
                            [measured]() -> Result<Measured> { return measured; },
                            {},
                            each.picture.seconds});
  }
  study.groups.push_back(std::move(group));
  return study;
}

}  // namespace cuticle::study
