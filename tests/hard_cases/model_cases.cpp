// Fibre models: {"model", "set", "quantity", "lobe"} at every combination of the angles (degrees) and h given. The quantity "sample" draws a
// direction for each by every number of "u", used for all eight: density and weight.
#include "bsdf/model.h"
#include "core/json/json.h"
#include "tests/hard_cases/model_points.h"
#include "tests/hard_cases/subject.h"
#ifdef CUTICLE_HAS_GPU
#include "tests/hard_cases/gpu_session.h"
#endif

namespace cuticle::hard_cases {
namespace {

struct Batch {
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;
  bsdf::Quantity quantity{};
  int lobe = -1;
  std::vector<bsdf::Point> points;
  bsdf::Request request() const { return {quantity, lobe, points}; }
};

bool is_sample(const Json& inputs) { return inputs.at("quantity") == "sample"; }

std::vector<bsdf::SampleQuery> queries_from(const Json& inputs) {
  std::vector<bsdf::SampleQuery> queries;
  for (const bsdf::Point& point : points_from(inputs))
    for (double u : numbers(inputs.at("u"))) {
      queries.push_back({.theta_o = point.theta_o, .phi_o = point.phi_o, .h = point.h});
      queries.back().u.fill(u);
    }
  return queries;
}

Result<Batch> batch_from(const Json& inputs) {
  Batch batch;
  CUTICLE_ASSIGN(batch.model, bsdf::find_model(inputs.at("model").text()));
  CUTICLE_ASSIGN(batch.values, registry::parse_assignments(batch.model->entry.parameters, inputs.value("set", std::string())));
  if (!is_sample(inputs)) {
    CUTICLE_ASSIGN(batch.quantity, bsdf::find_quantity(inputs.at("quantity").text()));
  }
  CUTICLE_ASSIGN(batch.lobe, bsdf::find_lobe(*batch.model, inputs.value("lobe", std::string("sum"))));
  batch.points = points_from(inputs);
  return batch;
}

Values flat(std::span<const glm::dvec3> colors) {
  Values values;
  for (const glm::dvec3& color : colors) values.insert(values.end(), {color.x, color.y, color.z});
  return values;
}

Values flat(std::span<const bsdf::Sample> samples) {
  Values values;
  for (const bsdf::Sample& sample : samples)
    values.insert(values.end(), {sample.pdf, sample.weight.x, sample.weight.y, sample.weight.z});
  return values;
}

Result<Values> run(const Json& inputs, bsdf::Precision precision) {
  CUTICLE_ASSIGN(const Batch batch, batch_from(inputs));
  if (is_sample(inputs)) {
    const std::vector<bsdf::SampleQuery> queries = queries_from(inputs);
    std::vector<bsdf::Sample> samples(queries.size());
    CUTICLE_TRY(bsdf::sample(*batch.model, batch.values, precision, queries, samples));
    return flat(samples);
  }
  std::vector<glm::dvec3> out(batch.points.size());
  CUTICLE_TRY(bsdf::evaluate(*batch.model, batch.values, precision, batch.request(), out));
  return flat(out);
}

}  // namespace

Result<Values> run_model_f32(const Json& inputs, GpuSession*) { return run(inputs, bsdf::Precision::f32); }
Result<Values> run_model_f64(const Json& inputs, GpuSession*) { return run(inputs, bsdf::Precision::f64); }

#ifdef CUTICLE_HAS_GPU
namespace {

Result<bsdf::GpuEvaluator*> evaluator_of(const bsdf::Model& model, GpuSession& session) {
  auto found = session.evaluators.find(model.entry.name);
  if (found == session.evaluators.end()) {
    CUTICLE_ASSIGN(bsdf::GpuEvaluator evaluator, bsdf::GpuEvaluator::make(*session.device, model));
    found = session.evaluators.emplace(model.entry.name, std::move(evaluator)).first;
  }
  return &found->second;
}

}  // namespace

Result<Values> run_model_gpu(const Json& inputs, GpuSession* session) {
  CUTICLE_ASSIGN(const Batch batch, batch_from(inputs));
  std::vector<glm::dvec3> out(batch.points.size());
  CUTICLE_ASSIGN(bsdf::GpuEvaluator* evaluator, evaluator_of(*batch.model, *session));
  if (is_sample(inputs)) {
    const std::vector<bsdf::SampleQuery> queries = queries_from(inputs);
    std::vector<bsdf::Sample> samples(queries.size());
    CUTICLE_TRY(evaluator->sample(batch.values, queries, samples));
    return flat(samples);
  }
  CUTICLE_TRY(evaluator->evaluate(batch.values, batch.request(), out));
  return flat(out);
}
#endif

}  // namespace cuticle::hard_cases
