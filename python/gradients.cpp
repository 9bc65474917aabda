// Derivatives by every parameter.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "lut/fit/gradients.h"

#include "python/arrays.h"
#include "python/interruptible.h"
#include "python/points.h"

namespace cuticle::python {
namespace {

/// Names, values and derivatives.
nb::tuple gradients(const std::string& model_name, const std::string& quantity_name, const std::string& lobe_name,
                    const std::string& preset, const std::string& settings, const std::vector<std::string>& names,
                    const std::vector<Numbers>& coordinates) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const registry::ParameterValues values = value_or_raise(bsdf::parse_settings(*model, preset, settings));
  const bsdf::Quantity quantity = value_or_raise(bsdf::find_quantity(quantity_name));
  const int lobe = value_or_raise(bsdf::find_lobe(*model, lobe_name));
  std::vector<std::size_t> shape = broadcast_shape(coordinates);
  const PointReader reader(coordinates, shape);
  std::vector<bsdf::Point> points;
  require(reader.read(0, reader.count(), points));
  lut::Gradients result = value_or_raise(interruptible([&] {
    return lut::evaluate_gradients(*model, values, names, {quantity, lobe, points});
  }));
  std::vector<double> flat;
  for (const glm::dvec3& value : result.values) flat.insert(flat.end(), {value.x, value.y, value.z});
  shape.push_back(3);
  const auto array = take(std::move(flat), shape);
  shape.push_back(result.names.size());
  return nb::make_tuple(result.names, array, take(std::move(result.derivatives), shape));
}

}  // namespace

void add_gradients(nb::module_& module) { module.def("gradients", &gradients); }

}  // namespace cuticle::python
