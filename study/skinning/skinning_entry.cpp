#include "study/registry/entries.h"
#include "study/skinning/twist_study.h"

namespace cuticle::study {
namespace {

Result<Study> declare_skinning(const StudyRequest& request, Progress&) { return twist_declaration(request.quick ? 129 : 1025); }

}  // namespace

const StudyEntry& skinning_entry() {
  static const StudyEntry entry{.name = "skinning",
                                .summary = "a twisted tube: the volume that linear blend and dual quaternions keep",
                                .declare = declare_skinning,
                                .quick_seconds = 1,
                                .seconds = 5};
  return entry;
}

}  // namespace cuticle::study
