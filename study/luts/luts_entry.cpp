#include "study/engine/split.h"
#include "study/luts/luts_study.h"
#include "study/registry/entries.h"

namespace cuticle::study {
namespace {

Result<Study> declare_luts(const StudyRequest& request, Progress& progress) {
  LutsRequest luts;
  luts.models = split_commas(request.options.at("models"));
  luts.layouts = split_commas(request.options.at("layouts"));
  luts.settings = request.options.at("set");
  if (request.quick) {
    luts.sizes = {16, 64};
    luts.formats = {"exr", "png8"};
    luts.fits = {"none"};
    luts.points = 512;
  }
  return luts_study(luts, progress);
}

}  // namespace

const StudyEntry& luts_entry() {
  static const StudyEntry entry{.name = "luts",
                                .summary = "lookup tables beside the model: error against bytes and time",
                                .options = {{"models", "marschner", "models, a,b,c"},
                                            {"layouts", "", "layouts, a,b,c; without it all whose tables make S"},
                                            {"set", "", "parameters of every model, name=value,name=value"}},
                                .declare = declare_luts,
                                .quick_seconds = 10,
                                .seconds = 120};
  return entry;
}

}  // namespace cuticle::study
