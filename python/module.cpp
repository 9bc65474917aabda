#include <optional>

#include <fmt/core.h>
#include <tbb/global_control.h>

#include "core/registry/former_names.h"
#include "python/arrays.h"
#include "python/interruptible.h"

namespace {

/// Threads that parallel work may take from now on; 0: all.
void set_threads(int count) {
  static std::optional<tbb::global_control> limit;
  limit.reset();
  if (count > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(count));
}

void warn_of_former_name(std::string_view former, std::string_view now) {
  const nanobind::gil_scoped_acquire held;
  const std::string text =
      fmt::format("'{}' is called '{}' now; the next version no longer reads the former name", former, now);
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) < 0) PyErr_WriteUnraisable(nullptr);
}

}  // namespace

NB_MODULE(_cuticle, module) {
  module.doc() = "The compiled half of the package cuticle.";
  using namespace cuticle::python;
  cuticle::registry::set_former_name_listener(warn_of_former_name);
  add_errors(module);
  add_batch(module);
  add_cards(module);
  add_check(module);
  module.def("version", [] { return CUTICLE_VERSION; });
  module.def("set_threads", &set_threads);
  module.def(
      "set_ticker", [](nb::handle call) { ticker = call.is_none() ? nullptr : call.ptr(); }, nb::arg().none());
  add_evaluate(module);
  add_fitting(module);
  add_gradients(module);
  add_groom(module);
  add_grooming(module);
  add_registries(module);
  add_render(module);
  add_sampling(module);
  add_shadows(module);
  add_simulation(module);
  add_studies(module);
  add_tables(module);
  add_views(module);
}
