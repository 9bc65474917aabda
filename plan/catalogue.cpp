#include <cuticle/bsdf/model.h>
#include <cuticle/lut/table_set.h>
#include <cuticle/plan/plan.h>
#include <cuticle/render/pass.h>
#include <cuticle/shadows/method.h>
#include <cuticle/sim/solver.h>

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
