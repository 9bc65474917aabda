#include "python/arrays.h"

NB_MODULE(_cuticle, module) {
  module.doc() = "The compiled half of the package cuticle.";
  using namespace cuticle::python;
  add_errors(module);
  add_batch(module);
  add_check(module);
  add_evaluate(module);
  add_gradients(module);
  add_groom(module);
  add_grooming(module);
  add_registries(module);
  add_render(module);
  add_sampling(module);
  add_shadows(module);
  add_simulation(module);
  add_tables(module);
}
