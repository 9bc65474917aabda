#include "study/motion/motion_study.h"
#include "study/registry/entries.h"

namespace cuticle::study {
namespace {

Result<Study> declare_motion(const StudyRequest& request, Progress& progress) {
  return motion_study(request.quick ? quick_motion_request() : MotionRequest{}, progress);
}

}  // namespace

const StudyEntry& motion_entry() {
  static const StudyEntry entry{.name = "motion",
                                .summary = "strand solvers: error against time by substeps and iterations",
                                .declare = declare_motion,
                                .seconds = 180};
  return entry;
}

}  // namespace cuticle::study
