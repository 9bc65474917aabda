// The entry of the loaded module.
#include "viz/lobes/lobes_view.h"
#include "viz/lobes/paths_view.h"
#include "viz/plan/plan_view.h"
#include "viz/shadow/shadow_view.h"
#include "viz/strands/strands_view.h"
#include "viz/tables/tables_view.h"
#include "viz/views.h"

namespace cuticle::viz {
namespace {

template <class Picture, class Shown>
Result<void> show(const Shown& shown, const ViewTarget& target) {
  Picture picture(shown);
  return present(picture, target);
}

}  // namespace
}  // namespace cuticle::viz

extern "C" const cuticle::viz::Views* cuticle_views() {
  using namespace cuticle::viz;
  static const Views views{.lobes = show<LobesPicture>,
                           .paths = show<PathsPicture>,
                           .tables = show<TablesPicture>,
                           .strands = show<StrandsPicture>,
                           .shadow = show<ShadowPicture>,
                           .plan = show<PlanPicture>};
  return &views;
}
