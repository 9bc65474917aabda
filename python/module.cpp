#include "python/arrays.h"

NB_MODULE(_cuticle, module) {
  module.doc() = "The compiled half of the package cuticle.";
  cuticle::python::add_check(module);
  cuticle::python::add_evaluate(module);
  cuticle::python::add_tables(module);
  cuticle::python::add_groom(module);
}
