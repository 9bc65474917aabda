// S from tables and from the model as points of the study.
#include <cmath>
#include <random>

#include "bsdf/batch/batch.h"
#include "study/luts/luts_study.h"

namespace cuticle::study {
namespace {

constexpr double k_turn = 6.283185307179586;

void add(std::array<std::vector<float>, 3>& to, double sine, double phi) {
  const double cosine = std::sqrt((1 - sine) * (1 + sine));
  to[0].push_back(float(sine));
  to[1].push_back(float(cosine * std::cos(phi)));
  to[2].push_back(float(cosine * std::sin(phi)));
}

/// Of each direction: the root of the mean square over the colours, over that of the whole truth.
std::vector<double> errors_of(std::span<const glm::dvec3> values, std::span<const glm::dvec3> truth) {
  double signal = 0;
  for (const glm::dvec3& value : truth) signal += (value.x * value.x + value.y * value.y + value.z * value.z) / 3;
  const double scale = 1 / std::sqrt(std::max(signal / double(truth.size()), 1e-300));
  std::vector<double> errors(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const glm::dvec3 off = values[i] - truth[i];
    errors[i] = scale * std::sqrt((off.x * off.x + off.y * off.y + off.z * off.z) / 3);
  }
  return errors;
}

using Shared = std::shared_ptr<const LutDirections>;
using Colors = std::vector<glm::dvec3>;

Point scalar_point(const bsdf::Model& model, const registry::ParameterValues& values, const Shared& on) {
  const auto out = std::make_shared<Colors>(on->points.size());
  const auto run = [&model, values, on, out]() -> Result<void> {
    model.evaluate_f32(values, {bsdf::Quantity::S, -1, on->points}, *out);
    return {};
  };
  const auto measure = [run, on, out]() -> Result<Measured> {
    CUTICLE_TRY(run());
    return Measured{{errors_of(*out, on->truth)}};
  };
  return {"the model, float", {}, measure, {{}, run, double(on->points.size())}};
}

/// In the best instruction set, in blocks that one thread takes.
Result<Point> batch_point(const bsdf::Model& model, const registry::ParameterValues& values, const Shared& on) {
  CUTICLE_ASSIGN(bsdf::BatchEvaluator made, bsdf::BatchEvaluator::make(model, values));
  const auto evaluator = std::make_shared<const bsdf::BatchEvaluator>(std::move(made));
  const auto color = std::make_shared<std::array<std::vector<float>, 3>>();
  for (std::vector<float>& each : *color) each.resize(on->points.size());
  const auto run = [evaluator, on, color]() -> Result<void> {
    const auto in = [](const std::array<std::vector<float>, 3>& v) { return bsdf::VectorSpans{v[0], v[1], v[2]}; };
    return evaluator->evaluate({in(on->light), in(on->viewer), {}}, {(*color)[0], (*color)[1], (*color)[2]});
  };
  const auto measure = [run, on, color]() -> Result<Measured> {
    CUTICLE_TRY(run());
    Colors out(on->points.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = glm::dvec3((*color)[0][i], (*color)[1][i], (*color)[2][i]);
    return Measured{{errors_of(out, on->truth)}};
  };
  const std::string name = evaluator->is_vectorised() ? "the model, arrays" : "the model, arrays (scalar)";
  return Point{name, {}, measure, {{}, run, double(on->points.size())}};
}

}  // namespace

Shared lut_directions(const bsdf::Model& model, const registry::ParameterValues& values, std::size_t count) {
  std::mt19937 generator(20260201);
  std::uniform_real_distribution<double> even(0, 1);
  const auto on = std::make_shared<LutDirections>();
  for (std::size_t i = 0; i < count; ++i) {
    const double sin_i = 2 * even(generator) - 1, sin_o = 2 * even(generator) - 1;
    const double phi_i = k_turn * even(generator), phi_o = k_turn * even(generator);
    add(on->light, sin_i, phi_i);
    add(on->viewer, sin_o, phi_o);
    bsdf::Point& at = on->points.emplace_back();
    at.theta_i = std::asin(sin_i);
    at.theta_o = std::asin(sin_o);
    at.theta_d = (at.theta_o - at.theta_i) / 2;
    at.phi = phi_o - phi_i;
    on->inputs.push_back({float(sin_i), float(sin_o), float(std::cos(at.phi))});
  }
  on->truth.resize(count);
  model.evaluate_f64(values, {bsdf::Quantity::S, -1, on->points}, on->truth);
  return on;
}

Result<std::vector<Point>> direct_points(const bsdf::Model& model, const registry::ParameterValues& values, Shared on) {
  std::vector<Point> points = {scalar_point(model, values, on)};
  CUTICLE_ASSIGN(points.emplace_back(), batch_point(model, values, on));
  return points;
}

Result<Point> table_point(const lut::TableSet& set, std::string method, std::size_t bytes, Shared on) {
  CUTICLE_ASSIGN(TableSampler made, TableSampler::make(set));
  const auto sampler = std::make_shared<const TableSampler>(std::move(made));
  const auto measure = [sampler, on, bytes]() -> Result<Measured> {
    Colors out;
    for (const ShaderInputs& in : on->inputs) out.emplace_back(sampler->scattering(in));
    return Measured{{errors_of(out, on->truth)}, double(bytes)};
  };
  const auto run = [sampler, on]() -> Result<void> {
    glm::vec3 sum(0);
    for (const ShaderInputs& in : on->inputs) sum += sampler->scattering(in);
    volatile float sink = sum.x + sum.y + sum.z;
    static_cast<void>(sink);
    return {};
  };
  return Point{std::move(method), {{"size", std::to_string(set.size)}}, measure, {{}, run, double(on->points.size())}};
}

}  // namespace cuticle::study
