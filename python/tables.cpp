#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include "lut/format.h"
#include "lut/table_set.h"

#include "python/arrays.h"
#include "python/signals.h"

namespace cuticle::python {
namespace {

/// Baked and certified, as half.
Result<lut::TableSet> make_tables(const std::string& model_name, const std::string& layout_name, int size,
                                  const std::string& preset, const std::string& settings) {
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(model_name));
  CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(*model, preset, settings));
  CUTICLE_ASSIGN(const lut::Layout* layout, lut::find_layout(layout_name, *model, values));
  SignalProgress progress;
  CUTICLE_ASSIGN(lut::TableSet set, lut::bake(*model, values, *layout, size, progress));
  CUTICLE_TRY(lut::certify(set, lut::half_exr(), progress));
  return set;
}

Result<lut::TableSet> make_without_lock(const std::string& model, const std::string& layout, int size,
                                        const std::string& preset, const std::string& settings) {
  nb::gil_scoped_release released;
  return make_tables(model, layout, size, preset, settings);
}

nb::tuple bake(const std::string& model, const std::string& layout, int size, const std::string& preset,
               const std::string& settings) {
  lut::TableSet set = value_or_raise(make_without_lock(model, layout, size, preset, settings));
  nb::dict tables;
  const std::string manifest = lut::manifest_json(set, lut::half_exr());
  for (lut::Table& table : set.tables) {
    const std::vector<std::size_t> shape = {std::size_t(set.size), std::size_t(set.size), table.scale.size()};
    tables[nb::str(table.layout->name.data(), table.layout->name.size())] = take(std::move(table.image.pixels), shape);
  }
  return nb::make_tuple(tables, manifest);
}

}  // namespace

void add_tables(nb::module_& module) { module.def("bake", &bake); }

}  // namespace cuticle::python
