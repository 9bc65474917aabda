#include "study/engine/split.h"
#include "study/mechanics/mechanics_study.h"
#include "study/registry/entries.h"

namespace cuticle::study {
namespace {

Result<Study> declare_mechanics(const StudyRequest& request, Progress& progress) {
  return mechanics_study({request.quick, split_commas(request.options.at("experiments"))}, progress);
}

}  // namespace

const StudyEntry& mechanics_entry() {
  static const StudyEntry entry{
      .name = "mechanics",
      .summary =
          "strand solvers against bench-top experiments: cantilever, buckling, capstan, hanging chain, frequencies, drape",
      .options = {{"experiments", "", "some of them, a,b,c; none: all", true}},
      .declare = declare_mechanics,
      .quick_seconds = 18,
      .seconds = 44};
  return entry;
}

}  // namespace cuticle::study
