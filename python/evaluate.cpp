#include <algorithm>
#include <numbers>

#include <fmt/format.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bsdf/fibre/fibres.h"
#include "bsdf/listing/listing.h"
#include "bsdf/model.h"
#include "bsdf/pigment/pigment.h"

#include "core/memory_limit.h"
#include "python/arrays.h"
#include "python/signals.h"

namespace cuticle::python {
namespace {

constexpr std::array<double bsdf::Point::*, bsdf::coordinate_count> k_members = {
    &bsdf::Point::theta_i, &bsdf::Point::theta_o, &bsdf::Point::theta_d,
    &bsdf::Point::phi,     &bsdf::Point::h,       &bsdf::Point::phi_o};
constexpr std::size_t k_offset = 4;  // h is no angle

std::vector<bsdf::Point> make_points(const std::vector<Numbers>& coordinates, const std::vector<std::size_t>& shape) {
  std::size_t count = 1;
  for (std::size_t length : shape) count *= length;
  std::vector<bsdf::Point> points(count);
  for (std::size_t c = 0; c < k_members.size(); ++c) {
    const double unit = c == k_offset ? 1 : std::numbers::pi / 180;
    for (std::size_t i = 0; i < count; ++i)
      points[i].*k_members[c] = coordinates[c].data()[broadcast_index(coordinates[c], shape, i)] * unit;
  }
  return points;
}

bsdf::Precision find_precision(const std::string& name) {
  if (name == "f64") return bsdf::Precision::f64;
  if (name == "f32") return bsdf::Precision::f32;
  raise(usage_error("precision '" + name + "' is not one of f32, f64",
                    "the program for the GPU: cuticle eval --precision gpu"));
}

/// A named hair in the model's parameters. Error: usage.
Result<bsdf::FibreMapping> map_hair(const bsdf::Model& model, const std::string& hair) {
  CUTICLE_ASSIGN(const bsdf::NamedFibre named, bsdf::find_fibre(hair));
  if (!model.from_fibre)
    return usage_error("model " + std::string(model.entry.name) + " has no mapping from a hair", "set={...}");
  return model.from_fibre(named.fibre);
}

/// Settings over the hair, where one is named, or over the preset.
registry::ParameterValues find_values(const bsdf::Model& model, const std::string& preset, const std::string& settings,
                                      const std::string& hair) {
  if (hair.empty()) return value_or_raise(bsdf::parse_settings(model, preset, settings));
  if (!preset.empty()) raise(usage_error("preset and hair exclude each other"));
  const std::string mapped = value_or_raise(map_hair(model, hair)).settings;
  return value_or_raise(bsdf::parse_settings(model, "", settings.empty() ? mapped : mapped + "," + settings));
}

/// Points, values and the array that is returned.
Result<void> require_room(const std::vector<std::size_t>& shape) {
  constexpr std::uint64_t huge = std::uint64_t(1) << 56, bytes_of_point = sizeof(bsdf::Point) + 2 * sizeof(glm::dvec3);
  const std::vector<std::uint64_t> lengths(shape.begin(), shape.end());
  const std::uint64_t count = product_within(huge, lengths).value_or(huge);
  return require_memory(fmt::format("broadcasting to {} points", fmt::join(lengths, " x ")), {count, bytes_of_point});
}

/// Without the interpreter's lock; between two parts a signal may end it.
Result<void> evaluate_in_parts(const bsdf::Model& model, const registry::ParameterValues& values,
                               bsdf::Precision precision, const bsdf::Request& request, std::span<glm::dvec3> out) {
  const std::size_t part = request.quantity == bsdf::Quantity::albedo ? 1 << 8 : 1 << 18;  // of albedo each is an integral
  const nb::gil_scoped_release released;
  for (std::size_t first = 0; first < out.size(); first += part) {
    const std::size_t count = std::min(part, out.size() - first);
    CUTICLE_TRY(bsdf::evaluate(model, values, precision,
                               {request.quantity, request.lobe, request.points.subspan(first, count)},
                               out.subspan(first, count)));
    raise_signals();
  }
  return {};
}

/// What a model's quantity depends on, by the names of eval's arguments less "_deg".
std::vector<std::string> needed(const std::string& model_name, const std::string& quantity_name,
                                const std::string& preset, const std::string& settings, const std::string& hair) {
  constexpr std::array<const char*, bsdf::coordinate_count> names = {"theta_i", "theta_o", "theta_d",
                                                                     "phi",     "h",       "phi_o"};
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const registry::ParameterValues values = find_values(*model, preset, settings, hair);
  const auto used = bsdf::coordinates_of(*model, values, value_or_raise(bsdf::find_quantity(quantity_name)));
  std::vector<std::string> result;
  for (std::size_t c = 0; c < names.size(); ++c)
    if (used[c]) result.emplace_back(names[c]);
  return result;
}

OutputArray evaluate(const std::string& model_name, const std::string& quantity_name, const std::string& lobe_name,
                     const std::string& preset, const std::string& settings, const std::string& hair,
                     const std::vector<Numbers>& coordinates, const std::string& precision_name) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const registry::ParameterValues values = find_values(*model, preset, settings, hair);
  const bsdf::Quantity quantity = value_or_raise(bsdf::find_quantity(quantity_name));
  const int lobe = value_or_raise(bsdf::find_lobe(*model, lobe_name));
  const bsdf::Precision precision = find_precision(precision_name);
  std::vector<std::size_t> shape = broadcast_shape(coordinates);
  const Result<void> fits = require_room(shape);
  if (!fits) raise(fits.error());
  const std::vector<bsdf::Point> points = make_points(coordinates, shape);
  std::vector<glm::dvec3> rgb(points.size());
  const Result<void> done = evaluate_in_parts(*model, values, precision, {quantity, lobe, points}, rgb);
  if (!done) raise(done.error());
  std::vector<double> flat;
  flat.reserve(rgb.size() * 3);
  for (const glm::dvec3& value : rgb) flat.insert(flat.end(), {value.x, value.y, value.z});
  shape.push_back(3);
  return take(std::move(flat), shape);
}

/// (settings, words) of a hair in a model's parameters.
std::pair<std::string, std::string> hair_mapping(const std::string& model_name, const std::string& hair) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const bsdf::FibreMapping mapping = value_or_raise(map_hair(*model, hair));
  return {mapping.settings, mapping.words};
}

std::vector<std::string> hairs() {
  std::vector<std::string> names;
  for (const bsdf::NamedFibre& named : bsdf::fibres()) names.emplace_back(named.name);
  return names;
}

using Color = std::array<double, 3>;

Color as_color(const glm::dvec3& rgb) { return {rgb.x, rgb.y, rgb.z}; }

Color absorption_of_pigments(const std::string& table, double eumelanin, double pheomelanin) {
  const bsdf::PigmentTable found = value_or_raise(bsdf::find_pigment_table(table));
  return as_color(value_or_raise(bsdf::absorption_of_pigments(found, eumelanin, pheomelanin)));
}

Color absorption_of_assembly(const Color& color, double beta_n) {
  return as_color(value_or_raise(bsdf::absorption_of_assembly({color[0], color[1], color[2]}, beta_n)));
}

Color absorption_of_fibre(const std::string& model_name, const Color& color, const std::string& settings) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const registry::ParameterValues values = value_or_raise(bsdf::parse_settings(*model, "", settings));
  return as_color(value_or_raise(bsdf::absorption_of_fibre(*model, values, {color[0], color[1], color[2]})));
}

std::vector<std::string> lobes(const std::string& model_name) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  return {model->lobes.begin(), model->lobes.end()};
}

}  // namespace

void add_evaluate(nb::module_& module) {
  module.def("evaluate", &evaluate);
  module.def("needed", &needed);
  module.def("absorption_of_pigments", &absorption_of_pigments);
  module.def("absorption_of_assembly", &absorption_of_assembly);
  module.def("absorption_of_fibre", &absorption_of_fibre);
  module.def("hair_mapping", &hair_mapping);
  module.def("hairs", &hairs);
  module.def("models_json", &bsdf::models_json);
  module.def("lobes", &lobes);
}

}  // namespace cuticle::python
