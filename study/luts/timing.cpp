// Time of S: from tables, and from the model.
#include <chrono>
#include <cmath>
#include <random>

#include "bsdf/batch/batch.h"
#include "study/luts/luts_study.h"
#include "study/luts/table_sampler.h"

namespace cuticle::study {
namespace {

constexpr double k_turn = 6.283185307179586;

/// Directions that fill the sphere evenly, as vectors, angles and what a shader has of them.
struct Directions {
  std::array<std::vector<float>, 3> light, viewer;
  std::vector<bsdf::Point> points;
  std::vector<ShaderInputs> inputs;

  explicit Directions(std::size_t count) {
    std::mt19937 generator(20260201);
    std::uniform_real_distribution<double> even(0, 1);
    for (std::size_t i = 0; i < count; ++i) {
      const double sin_i = 2 * even(generator) - 1, sin_o = 2 * even(generator) - 1;
      const double phi_i = k_turn * even(generator), phi_o = k_turn * even(generator);
      add(light, sin_i, phi_i);
      add(viewer, sin_o, phi_o);
      bsdf::Point& at = points.emplace_back();
      at.theta_i = std::asin(sin_i);
      at.theta_o = std::asin(sin_o);
      at.theta_d = (at.theta_o - at.theta_i) / 2;
      at.phi = phi_o - phi_i;
      inputs.push_back({float(sin_i), float(sin_o), float(std::cos(at.phi))});
    }
  }
  static void add(std::array<std::vector<float>, 3>& to, double sine, double phi) {
    const double cosine = std::sqrt((1 - sine) * (1 + sine));
    to[0].push_back(float(sine));
    to[1].push_back(float(cosine * std::cos(phi)));
    to[2].push_back(float(cosine * std::sin(phi)));
  }
};

/// Nanoseconds a point of the best run; long work runs once.
template <class Work>
double best_ns(std::size_t points, int repeats, const Work& work) {
  double best = 1e300;
  for (int run = 0; run < repeats; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    best = std::min(best, time.count());
    if (time.count() > 5e8) break;
  }
  return best / double(points);
}

/// rms of the difference over the rms of the truth, all colours.
double relative_rms(std::span<const glm::dvec3> values, std::span<const glm::dvec3> truth) {
  double error = 0, signal = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      error += (values[i][c] - truth[i][c]) * (values[i][c] - truth[i][c]);
      signal += truth[i][c] * truth[i][c];
    }
  return signal > 0 ? std::sqrt(error / signal) : 0;
}

/// A model on one set of directions.
class DirectTimer {
 public:
  DirectTimer(const bsdf::Model& model, const registry::ParameterValues& values, std::size_t points, int repeats)
      : model_(model), values_(values), repeats_(repeats), on_(points) {}

  DirectRow scalar(int lobe, bool in_double) const {
    std::vector<glm::dvec3> truth(on_.points.size()), out = truth;
    const bsdf::Request request{bsdf::Quantity::S, lobe, on_.points};
    model_.evaluate_f64(values_, request, truth);
    DirectRow row = named(in_double ? "double" : "float", lobe);
    row.ns = best_ns(out.size(), repeats_,
                     [&] { (in_double ? model_.evaluate_f64 : model_.evaluate_f32)(values_, request, out); });
    row.rms_error = relative_rms(out, truth);
    return row;
  }

  /// In the best instruction set, in blocks that one thread takes.
  Result<DirectRow> batch() const {
    CUTICLE_ASSIGN(const bsdf::BatchEvaluator evaluator, bsdf::BatchEvaluator::make(model_, values_));
    std::array<std::vector<float>, 3> color;
    for (std::vector<float>& each : color) each.resize(on_.points.size());
    const auto in = [](const std::array<std::vector<float>, 3>& v) { return bsdf::VectorSpans{v[0], v[1], v[2]}; };
    Result<void> done;
    DirectRow row = named(evaluator.is_vectorised() ? "float, batch" : "float, batch (scalar)", -1);
    row.ns = best_ns(on_.points.size(), repeats_, [&] {
      done = evaluator.evaluate({in(on_.light), in(on_.viewer), {}}, {color[0], color[1], color[2]});
    });
    CUTICLE_TRY(done);
    std::vector<glm::dvec3> truth(on_.points.size()), out = truth;
    model_.evaluate_f64(values_, {bsdf::Quantity::S, -1, on_.points}, truth);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = glm::dvec3(color[0][i], color[1][i], color[2][i]);
    row.rms_error = relative_rms(out, truth);
    return row;
  }

 private:
  DirectRow named(std::string path, int lobe) const {
    return {std::string(model_.entry.name), std::move(path),
            lobe < 0 ? "S" : std::string(model_.lobes[std::size_t(lobe)])};
  }
  const bsdf::Model& model_;
  const registry::ParameterValues& values_;
  int repeats_;
  Directions on_;
};

}  // namespace

Result<double> sampling_ns(const lut::TableSet& set, std::size_t points, int repeats) {
  CUTICLE_ASSIGN(const TableSampler sampler, TableSampler::make(set));
  const Directions on(points);
  volatile float sink = 0;
  const double ns = best_ns(points, repeats, [&] {
    glm::vec3 sum(0);
    for (const ShaderInputs& in : on.inputs) sum += sampler.scattering(in);
    sink = sum.x + sum.y + sum.z;
  });
  static_cast<void>(sink);
  return ns;
}

Result<std::vector<DirectRow>> measure_direct(const bsdf::Model& model, const registry::ParameterValues& values,
                                              std::size_t points, int repeats) {
  const DirectTimer timer(model, values, points, repeats);
  std::vector<DirectRow> rows = {timer.scalar(-1, true), timer.scalar(-1, false)};
  CUTICLE_ASSIGN(rows.emplace_back(), timer.batch());
  for (int lobe = 0; lobe < int(model.lobes.size()); ++lobe) rows.push_back(timer.scalar(lobe, false));
  return rows;
}

}  // namespace cuticle::study
