// Parameters of models from measured lobes.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "lut/fit/model_fit.h"

#include "python/arrays.h"
#include "python/interruptible.h"
#include "python/points.h"

namespace cuticle::python {
namespace {

/// Rows of r, g, b, or of one number.
void set_values(const Numbers& values, lut::Measurements& data) {
  data.one_number = values.ndim() == 1;
  const std::size_t count = data.rows.size();
  const bool fits = values.ndim() == 1 || (values.ndim() == 2 && values.shape(1) == 3);
  if (!fits || values.shape(0) != count)
    raise(usage_error("values: not (n) or (n, 3) numbers for " + std::to_string(count) + " points"));
  const double* from = values.data();
  for (std::size_t i = 0; i < count; ++i)
    data.rows[i].value =
        data.one_number ? glm::dvec3(from[i]) : glm::dvec3(from[3 * i], from[3 * i + 1], from[3 * i + 2]);
}

lut::Measurements measurements(const bsdf::Model& model, const std::string& quantity,
                               const std::vector<std::string>& lobes, const std::vector<Numbers>& coordinates,
                               const Numbers& values, const std::optional<Numbers>& sigma) {
  const std::vector<std::size_t> shape = broadcast_shape(coordinates);
  const PointReader reader(coordinates, shape);
  std::vector<bsdf::Point> points;
  require(reader.read(0, reader.count(), points));
  lut::Measurements data{
      .quantity = value_or_raise(bsdf::find_quantity(quantity)), .rows = {}, .sigma_known = bool(sigma)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string& lobe = lobes.size() == 1 ? lobes[0] : lobes.at(i);
    data.rows.push_back({.point = points[i], .lobe = value_or_raise(bsdf::find_lobe(model, lobe))});
  }
  set_values(values, data);
  if (!sigma) return data;
  if (sigma->size() != data.rows.size()) raise(usage_error("sigma: not one number for each point"));
  for (std::size_t i = 0; i < data.rows.size(); ++i) data.rows[i].sigma = sigma->data()[i];
  return data;
}

std::string fit(const std::string& model_name, const std::string& preset, const std::string& settings,
                const std::vector<std::string>& free, const std::string& loss, const std::string& quantity,
                const std::vector<std::string>& lobes, const std::vector<Numbers>& coordinates, const Numbers& values,
                const std::optional<Numbers>& sigma) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const lut::FitRequest request{model, value_or_raise(bsdf::parse_settings(*model, preset, settings)), free,
                                value_or_raise(lut::find_loss(loss))};
  const lut::Measurements data = measurements(*model, quantity, lobes, coordinates, values, sigma);
  return lut::to_json(value_or_raise(interruptible([&] { return lut::fit_model(request, data); }))).dump();
}

}  // namespace

void add_fitting(nb::module_& module) {
  module.def("fit", &fit, nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(),
             nb::arg(), nb::arg().none());
}

}  // namespace cuticle::python
