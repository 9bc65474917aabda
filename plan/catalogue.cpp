#include "bsdf/model.h"
#include "lut/table_set.h"
#include "plan/plan.h"
#include "render/pass.h"
#include "shadows/method.h"
#include "sim/solver.h"

namespace cuticle::plan {

namespace {

template <class T>
std::vector<const registry::Entry*> entries_of(std::span<const T* const> registered) {
  std::vector<const registry::Entry*> entries;
  for (const T* item : registered) entries.push_back(&item->entry);
  return entries;
}

scene::Catalogue gather() {
  scene::Catalogue catalogue;
  catalogue.models = entries_of(bsdf::models());
  catalogue.layouts = entries_of(lut::layouts());
  catalogue.methods = entries_of(shadows::methods());
  catalogue.passes = entries_of(render::passes());
  for (const sim::Effect* effect : sim::effects())
    (effect->create ? catalogue.solvers : catalogue.effects).push_back(&effect->entry);
  return catalogue;
}

}  // namespace

const scene::Catalogue& catalogue() {
  static const scene::Catalogue gathered = gather();
  return gathered;
}

}  // namespace cuticle::plan
