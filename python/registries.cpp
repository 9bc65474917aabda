// What the registries hold, as JSON: the names that the other functions take.
#include <nanobind/stl/string.h>

#include "core/json/json.h"
#include "plan/plan.h"
#include "strands/formats/format.h"
#include "strands/shaping/shaping.h"

#include "python/arrays.h"

namespace cuticle::python {
namespace {

std::string shapings_json() {
  std::vector<const registry::Entry*> entries;
  for (const strands::Shaping* shaping : strands::shapings()) entries.push_back(&shaping->entry);
  return registry::to_json(entries);
}

std::string formats_json() {
  Json formats = Json::list();
  for (const strands::Format* format : strands::formats()) {
    Json extensions = Json::list(), read_only = Json::list();
    for (const std::string_view ending : format->extensions) extensions.push_back(ending);
    for (const std::string_view ending : format->read_only) read_only.push_back(ending);
    formats.push_back({{"name", format->name},
                       {"summary", format->summary},
                       {"extensions", extensions},
                       {"read_only", read_only},
                       {"writes", format->format != nullptr}});
  }
  return formats.dump();
}

std::string render_methods_json() {
  Json methods = Json::list();
  for (const std::string_view name : scene::k_render_methods) methods.push_back(name);
  return methods.dump();
}

/// "methods", "solvers", "effects", "passes", "layouts", "shapings", "formats", "render_methods".
std::string registry_json(const std::string& name) {
  const scene::Catalogue& catalogue = plan::catalogue();
  if (name == "methods") return registry::to_json(catalogue.methods);
  if (name == "solvers") return registry::to_json(catalogue.solvers);
  if (name == "effects") return registry::to_json(catalogue.effects);
  if (name == "passes") return registry::to_json(catalogue.passes);
  if (name == "layouts") return registry::to_json(catalogue.layouts);
  if (name == "shapings") return shapings_json();
  if (name == "formats") return formats_json();
  if (name == "render_methods") return render_methods_json();
  raise(usage_error("'" + name + "' is no registry"));
}

}  // namespace

void add_registries(nb::module_& module) { module.def("registry_json", &registry_json); }

}  // namespace cuticle::python
