#include "bsdf/fibre/fibres.h"
#include "study/engine/split.h"
#include "study/lobes/lobes_study.h"
#include "study/registry/entries.h"

namespace cuticle::study {
namespace {

Result<Study> declare_lobes(const StudyRequest& request, Progress& progress) {
  LobesRequest lobes;
  CUTICLE_ASSIGN(const bsdf::NamedFibre hair, bsdf::find_fibre(request.options.at("hair")));
  lobes.fibre = hair.fibre;
  lobes.fibre_name = request.options.at("hair");
  if (request.options.at("models") != "all") lobes.models = split_commas(request.options.at("models"));
  if (request.quick) {
    lobes.points = 128;
    lobes.samples = 91;
    lobes.walks = 50000;
  }
  return lobes_study(lobes, progress);
}

}  // namespace

const StudyEntry& lobes_entry() {
  static const StudyEntry entry{.name = "lobes",
                                .summary = "every fibre model: error against time of its tiers, and its lobes",
                                .options = {{"models", "all", "models, a,b,c, or all"},
                                            {"hair", "blond", "physical fibre that every model is mapped to"}},
                                .declare = declare_lobes,
                                .quick_seconds = 29,
                                .seconds = 240};
  return entry;
}

}  // namespace cuticle::study
