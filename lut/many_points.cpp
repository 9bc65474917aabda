// S at the many points that a layout's solver asks for.
#include <cmath>

#include "bsdf/batch/batch.h"
#include "lut/evaluate.h"

namespace cuticle::lut {
namespace {

/// Unit vectors in the fibre's frame, x along it.
struct Vectors {
  std::vector<float> x, y, z;
  void add(double theta, double phi) {
    x.push_back(float(std::sin(theta)));
    y.push_back(float(std::cos(theta) * std::cos(phi)));
    z.push_back(float(std::cos(theta) * std::sin(phi)));
  }
  bsdf::VectorSpans spans() const { return {x, y, z}; }
};

Result<void> evaluate_in_batch(const bsdf::BatchEvaluator& batch, std::span<const bsdf::Point> points,
                               std::span<glm::dvec3> out) {
  Vectors light, viewer;
  for (const bsdf::Point& at : points) {
    light.add(at.theta_i, 0);
    viewer.add(at.theta_o, at.phi);
  }
  std::vector<float> red(out.size()), green(out.size()), blue(out.size());
  CUTICLE_TRY(batch.evaluate({light.spans(), viewer.spans(), {}}, {red, green, blue}));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {red[i], green[i], blue[i]};
  return {};
}

/// Times a model's own paths of a viewer: for a solver, which averages over many viewers, and for what tables are
/// measured by, so that their noise shows.
constexpr int k_effort_to_solve = 2, k_effort_to_measure = 16;

Evaluate from_viewers(const bsdf::Model& model, const registry::ParameterValues& values, int effort) {
  return [&model, values, effort](const bsdf::Request& request, std::span<glm::dvec3> out) -> Result<void> {
    CUTICLE_TRY(bsdf::scattering_from_viewers(model, values, effort, request.lobe, request.points, out));
    return {};
  };
}

}  // namespace

Evaluate scattering_to_measure_by(const bsdf::Model& model, const registry::ParameterValues& values) {
  return model.scattering_from_viewer ? from_viewers(model, values, k_effort_to_measure) : Evaluate();
}

Evaluate scattering_at_many(const bsdf::Model& model, const registry::ParameterValues& values) {
  if (model.scattering_from_viewer) return from_viewers(model, values, k_effort_to_solve);
  return [&model, values](const bsdf::Request& request, std::span<glm::dvec3> out) -> Result<void> {
    const auto batch = bsdf::BatchEvaluator::make(model, values);
    if (batch.ok() && batch->integrates()) return evaluate_in_batch(*batch, request.points, out);
    return bsdf::evaluate(model, values, bsdf::Precision::f64, request, out);
  };
}

}  // namespace cuticle::lut
