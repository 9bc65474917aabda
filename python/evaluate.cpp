#include <numbers>

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cuticle/bsdf/model.h>

#include "arrays.h"

namespace cuticle::python {
namespace {

constexpr std::array<double bsdf::Point::*, 5> k_members = {&bsdf::Point::theta_i, &bsdf::Point::theta_o,
                                                            &bsdf::Point::theta_d, &bsdf::Point::phi, &bsdf::Point::h};

std::vector<bsdf::Point> make_points(const std::vector<Numbers>& coordinates, const std::vector<std::size_t>& shape) {
  std::size_t count = 1;
  for (std::size_t length : shape) count *= length;
  std::vector<bsdf::Point> points(count);
  for (std::size_t c = 0; c < k_members.size(); ++c) {
    const double unit = c < 4 ? std::numbers::pi / 180 : 1;
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

OutputArray evaluate(const std::string& model_name, const std::string& quantity_name, const std::string& lobe_name,
                     const std::string& preset, const std::string& settings, const std::vector<Numbers>& coordinates,
                     const std::string& precision_name) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const registry::ParameterValues values = value_or_raise(bsdf::parse_settings(*model, preset, settings));
  const bsdf::Quantity quantity = value_or_raise(bsdf::find_quantity(quantity_name));
  const int lobe = value_or_raise(bsdf::find_lobe(*model, lobe_name));
  const bsdf::Precision precision = find_precision(precision_name);
  std::vector<std::size_t> shape = broadcast_shape(coordinates);
  const std::vector<bsdf::Point> points = make_points(coordinates, shape);
  std::vector<glm::dvec3> rgb(points.size());
  Result<void> done;
  {
    nb::gil_scoped_release released;
    done = bsdf::evaluate(*model, values, precision, {quantity, lobe, points}, rgb);
  }
  if (!done) raise(done.error());
  std::vector<double> flat;
  flat.reserve(rgb.size() * 3);
  for (const glm::dvec3& value : rgb) flat.insert(flat.end(), {value.x, value.y, value.z});
  shape.push_back(3);
  return take(std::move(flat), shape);
}

std::string models_json() {
  std::vector<const registry::Entry*> entries;
  for (const bsdf::Model* model : bsdf::models()) entries.push_back(&model->entry);
  return registry::to_json(entries);
}

std::vector<std::string> lobes(const std::string& model_name) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  return {model->lobes.begin(), model->lobes.end()};
}

}  // namespace

void add_evaluate(nb::module_& module) {
  module.def("evaluate", &evaluate);
  module.def("models_json", &models_json);
  module.def("lobes", &lobes);
}

}  // namespace cuticle::python
