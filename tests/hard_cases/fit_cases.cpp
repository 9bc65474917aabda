// Parameters fitted to lobes: {"model", "truth" (settings that make the data), "start", "free": [names], "quantity",
// "lobe", "theta_i_deg", "theta_o_deg", "theta_d_deg", "phi_deg", "scale", "add", "flip"} gives the fitted numbers, or
// "measure": "groups" the number of groups of parameters that the data cannot tell apart. "scale", "add": what is done
// to the data; "flip": every second one with the other sign of "add".
#include "core/json/json.h"
#include "lut/fit/model_fit.h"
#include "tests/hard_cases/model_points.h"
#include "tests/hard_cases/subject.h"

namespace cuticle::hard_cases {
namespace {

Result<lut::Measurements> measurements_from(const Json& inputs, const bsdf::Model& model) {
  CUTICLE_ASSIGN(const registry::ParameterValues truth,
                 registry::parse_assignments(model.entry.parameters, inputs.value("truth", std::string())));
  lut::Measurements measurements;
  CUTICLE_ASSIGN(measurements.quantity, bsdf::find_quantity(inputs.value("quantity", std::string("S"))));
  measurements.one_number = true;
  CUTICLE_ASSIGN(const int lobe, bsdf::find_lobe(model, inputs.value("lobe", std::string("sum"))));
  const std::vector<bsdf::Point> points = points_from(inputs);
  std::vector<glm::dvec3> values(points.size());
  CUTICLE_TRY(bsdf::evaluate(model, truth, bsdf::Precision::f64, {measurements.quantity, lobe, points}, values));
  const double scale = inputs.value("scale", 1.0), add = inputs.value("add", 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double sign = inputs.contains("flip") && i % 2 == 1 ? -1 : 1;
    measurements.rows.push_back({.point = points[i], .lobe = lobe, .value = values[i] * scale + sign * add});
  }
  return measurements;
}

}  // namespace

Result<Values> run_fit_f64(const Json& inputs, GpuSession*) {
  lut::FitRequest request;
  CUTICLE_ASSIGN(request.model, bsdf::find_model(inputs.at("model").text()));
  CUTICLE_ASSIGN(request.start,
                 registry::parse_assignments(request.model->entry.parameters, inputs.value("start", std::string())));
  for (const Json& name : inputs.at("free")) request.free.push_back(name.text());
  CUTICLE_ASSIGN(const lut::Measurements measurements, measurements_from(inputs, *request.model));
  CUTICLE_ASSIGN(const lut::ModelFit fit, lut::fit_model(request, measurements));
  if (inputs.value("measure", std::string()) == "groups") return Values{double(fit.inseparable.size())};
  Values values;
  for (const lut::FittedParameter& parameter : fit.parameters) values.push_back(parameter.value);
  return values;
}

}  // namespace cuticle::hard_cases
