#pragma once
// What every model's CPU batch loops need: numbers narrowed to the precision asked for, points made ready for the
// formulas, and the loops themselves. A model's file ends with CUTICLE_MODEL.
#include <algorithm>
#include <cmath>

#include "bsdf/model.h"
#include "bsdf/shared/evaluation.glslh"
#include "bsdf/shared/prepared.glslh"
#include "core/real.h"
#include "core/registry/members.h"

namespace cuticle::bsdf {

template <class Real>
using Rgb = glm::vec<3, Real>;

/// A model's functions under the names that the loops below use: `Prepare` gives its struct in double from its
/// Parameters, `Evaluate` and `Draw` are stateless calls of evaluate and sample_direction.
template <auto Prepare, class Evaluate, class Draw>
struct FormulasOf {
  template <class Real>
  static auto prepare(const registry::ParameterValues& values) {
    return narrow<Real>(from_values(Prepare, values));
  }
  template <template <class> class Prepared, class Real>
  static Rgb<Real> evaluate(const Prepared<Real>& prepared, int quantity, int lobe, const EvaluationPoint<Real>& at) {
    return Evaluate{}(prepared, quantity, lobe, at);
  }
  template <template <class> class Prepared, class Real>
  static SampledDirection<Real> sample(const Prepared<Real>& prepared, const SamplePoint<Real>& at) {
    return Draw{}(prepared, at);
  }

 private:
  template <class Prepared, class Parameters>
  static Prepared from_values(Prepared (*prepare)(const Parameters&), const registry::ParameterValues& values) {
    return prepare(registry::from_values<Parameters>(values));
  }
};

/// An azimuth brought to [-pi, pi] in double, so that no digit is lost to turns when it is narrowed.
inline double wrapped(double phi) {
  return std::abs(phi) <= 3.141592653589793 ? phi : std::remainder(phi, 6.283185307179586);
}

template <class Real>
EvaluationPoint<Real> narrow(const Point& point) {
  return {Real(point.theta_i),      Real(point.theta_o), Real(point.theta_d),
          Real(wrapped(point.phi)), Real(point.h),       Real(wrapped(point.phi_o))};
}

template <class Real>
SamplePoint<Real> narrow(const SampleQuery& query) {
  SamplePoint<Real> at{Real(query.theta_o), Real(wrapped(query.phi_o)), Real(query.h), {}};
  // A number just below 1 may round up to it.
  for (std::size_t i = 0; i < query.u.size(); ++i) at.u[i] = std::min(Real(query.u[i]), Real(1) - Real(0x1p-24));
  return at;
}

template <class Formulas, class Real>
std::vector<Real> number_list(const registry::ParameterValues& values) {
  const auto numbers = numbers_of<Real>(Formulas::template prepare<double>(values));
  return {numbers.begin(), numbers.end()};
}

template <class Formulas, class Real>
void evaluate_points(const registry::ParameterValues& values, const Request& request, std::span<glm::dvec3> out) {
  const auto prepared = Formulas::template prepare<Real>(values);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] =
        glm::dvec3(Formulas::evaluate(prepared, int(request.quantity), request.lobe, narrow<Real>(request.points[i])));
}

/// S / pdf; 0 where the density is 0.
template <class Real>
glm::dvec3 sample_weight(const Rgb<Real>& scattering, Real pdf) {
  return pdf > 0 ? glm::dvec3(scattering) / double(pdf) : glm::dvec3(0);
}

template <class Formulas, class Real>
void sample_points(const registry::ParameterValues& values, std::span<const SampleQuery> queries,
                   std::span<Sample> out) {
  const auto prepared = Formulas::template prepare<Real>(values);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const SamplePoint<Real> query = narrow<Real>(queries[i]);
    const SampledDirection<Real> drawn = Formulas::sample(prepared, query);
    const EvaluationPoint<Real> at{drawn.theta_i, query.theta_o, Real(0), drawn.phi, query.h, query.phi_o};
    const Real pdf = Formulas::evaluate(prepared, CUTICLE_QUANTITY_PDF, -1, at).x;
    const Rgb<Real> scattering = Formulas::evaluate(prepared, CUTICLE_QUANTITY_S, -1, at);
    out[i] = {double(drawn.theta_i), double(drawn.phi), double(pdf), sample_weight(scattering, pdf), drawn.lobe};
  }
}

/// The model with the functions that its formulas give: evaluate, sample and pack.
template <class Formulas>
Model with_functions(Model model) {
  model.evaluate_f32 = evaluate_points<Formulas, Single>;
  model.evaluate_f64 = evaluate_points<Formulas, double>;
  model.sample_f32 = sample_points<Formulas, Single>;
  model.sample_f64 = sample_points<Formulas, double>;
  model.pack = number_list<Formulas, float>;
  return model;
}

}  // namespace cuticle::bsdf

/// What the registries ask of a model's namespace: its entry, and its numbers. `make` gives its struct in double from
/// its Parameters, `table` the Model without functions; these are made of evaluate and sample_direction.
#define CUTICLE_MODEL(make, table)                                                                \
  namespace {                                                                                     \
  using Formulas = FormulasOf<make, decltype([](const auto&... a) { return evaluate(a...); }),    \
                              decltype([](const auto&... a) { return sample_direction(a...); })>; \
  }                                                                                               \
  std::vector<double> prepared_numbers(const registry::ParameterValues& values) {                 \
    return number_list<Formulas, double>(values);                                                 \
  }                                                                                               \
  const Model& entry() {                                                                          \
    static const Model model = with_functions<Formulas>(table());                                 \
    return model;                                                                                 \
  }
