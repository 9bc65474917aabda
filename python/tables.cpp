// Tables: baked, fitted, written for engines, read again and checked; shader text.
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include "core/file.h"
#include "core/json/json.h"
#include "lut/check/check.h"
#include "lut/fit/analytic_fit.h"
#include "lut/fit/texel_fit.h"
#include "lut/format.h"
#include "lut/snippets/snippet.h"
#include "lut/table_set.h"
#include "lut/target.h"

#include "python/arrays.h"
#include "python/interruptible.h"
#include "python/signals.h"

namespace cuticle::python {
namespace {

struct BakeRequest {
  std::string model, layout, preset, settings, format, fit, targets, out;
  int size = 128;
};

/// Baked, fitted where that is asked for, certified in the format, and written where a folder is named.
Result<lut::TableSet> make_tables(const BakeRequest& request, const lut::Format& format, Progress& progress) {
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(request.model));
  CUTICLE_ASSIGN(const registry::ParameterValues values,
                 bsdf::parse_settings(*model, request.preset, request.settings));
  CUTICLE_ASSIGN(const lut::Layout* layout, lut::find_layout(request.layout, *model, values));
  CUTICLE_ASSIGN(const std::vector<const lut::Target*> targets, lut::find_targets(request.targets));
  CUTICLE_ASSIGN(lut::TableSet set, lut::bake(*model, values, *layout, request.size, progress));
  if (request.fit == "texels") {
    CUTICLE_ASSIGN(lut::TexelFit fitted, lut::fit_texels(set, format, progress));
    set = std::move(fitted.set);
  } else {
    CUTICLE_TRY(lut::certify(set, format, progress));
  }
  stop_if_cancelled();
  if (!request.out.empty()) CUTICLE_TRY(lut::write(set, format, request.out, targets));
  return set;
}

/// (v, u, channel): what the numbers stand for.
nb::object values_of(Image image, const std::vector<double>& scale) {
  const std::size_t channels = scale.size(), stored = std::size_t(image.channels());
  std::vector<float> values;
  values.reserve(image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (i % stored < channels) values.push_back(float(double(image.pixels[i]) * scale[i % stored]));
  return nb::cast(take(std::move(values), {std::size_t(image.height), std::size_t(image.width), channels}));
}

nb::tuple bake(const std::string& model, const std::string& layout, int size, const std::string& preset,
               const std::string& settings, const std::string& format_name, const std::string& fit,
               const std::string& targets, const std::string& out, const nb::object& call) {
  if (fit != "none" && fit != "texels") raise(usage_error("fit: '" + fit + "' is not one of none, texels"));
  const lut::Format& format = *value_or_raise(lut::find_format(format_name));
  const BakeRequest request{model, layout, preset, settings, format_name, fit, targets, out, size};
  CalledProgress progress(call);
  lut::TableSet set = value_or_raise(interruptible([&] { return make_tables(request, format, progress); }));
  nb::dict tables;
  const std::string manifest = lut::manifest_json(set, format);
  for (lut::Table& table : set.tables)
    tables[nb::str(table.layout->name.data(), table.layout->name.size())] =
        values_of(std::move(table.image), table.scale);
  return nb::make_tuple(tables, manifest);
}

/// The values in a folder's files, and its manifest's text.
nb::tuple read(const std::string& folder) {
  const lut::Manifest manifest = value_or_raise(lut::read_manifest(folder));
  const lut::Format& format = *value_or_raise(lut::find_format(manifest.format));
  nb::dict tables;
  for (const lut::ManifestTable& table : manifest.tables) {
    std::vector<double> scale;
    for (const lut::ManifestChannel& channel : table.channels) scale.push_back(channel.scale);
    Image image = value_or_raise(format.read(folder + "/" + table.file));
    if (std::size_t(image.channels()) < scale.size())
      raise(bad_input(table.file + ": fewer channels than its manifest says"));
    tables[table.name.c_str()] = values_of(std::move(image), scale);
  }
  return nb::make_tuple(tables, value_or_raise(read_text_file(folder + "/manifest.json")));
}

std::string check(const std::string& folder) {
  return lut::check::to_json(value_or_raise(interruptible([&] { return lut::check::check_folder(folder); })));
}

std::string snippet(const std::string& folder, const std::string& dialect_name) {
  const auto* dialect = value_or_raise(lut::snippets::find_dialect(dialect_name));
  return value_or_raise(lut::snippets::snippet(value_or_raise(lut::read_manifest(folder)), *dialect));
}

/// Shader code without textures, and its numbers with their errors as JSON.
nb::tuple analytic(const std::string& model_name, const std::string& preset, const std::string& settings,
                   const nb::object& call) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const auto values = value_or_raise(bsdf::parse_settings(*model, preset, settings));
  CalledProgress progress(call);
  const lut::AnalyticFit fit =
      value_or_raise(interruptible([&] { return lut::fit_analytic(*model, values, progress); }));
  return nb::make_tuple(lut::shader_code(fit), lut::to_json(fit));
}

/// Names that bake takes: "formats", "targets", "dialects".
std::string choices() {
  Json all = Json::object();
  for (const char* kind : {"formats", "targets", "dialects"}) all[kind] = Json::list();
  for (const lut::Format* format : lut::formats()) all["formats"].push_back(format->name);
  for (const lut::Target* target : lut::targets()) all["targets"].push_back(target->name);
  for (const lut::snippets::Dialect& dialect : lut::snippets::dialects()) all["dialects"].push_back(dialect.name);
  return all.dump();
}

}  // namespace

void add_tables(nb::module_& module) {
  module.def("bake", &bake, nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(),
             nb::arg(), nb::arg().none());
  module.def("read_tables", &read);
  module.def("check_tables", &check);
  module.def("snippet", &snippet);
  module.def("analytic", &analytic, nb::arg(), nb::arg(), nb::arg(), nb::arg().none());
  module.def("table_choices", &choices);
}

}  // namespace cuticle::python
