#include "lut/fit/analytic_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <ceres/ceres.h>
#include <fmt/format.h>

namespace cuticle::lut {
namespace {

constexpr double k_pi = std::numbers::pi;
constexpr int k_numbers = k_analytic_bumps * k_bump_numbers;
constexpr double k_lowest_cosine = 0.1;

template <class T>
T quadratic(const T* q, double c) {
  return q[0] + c * (q[1] + c * q[2]);
}

template <class T>
T bell(const T& x) {
  using std::exp;
  return exp(-0.5 * x * x);
}

template <class T>
T bump(const T* q, double phi, double c, double sigma) {
  using std::exp;
  const T middle = quadratic(q + 6, c), inverse = exp(-quadratic(q + 9, c));
  const T images = bell(T((phi - middle) * inverse)) + bell(T((phi + middle) * inverse)) +
                   bell(T((2 * k_pi - phi - middle) * inverse));
  return exp(quadratic(q, c) - sigma * quadratic(q + 3, c)) * images;
}

template <class T>
T bumps(const T* q, double phi, double c, double sigma) {
  T sum = bump(q, phi, c, sigma);
  for (int k = 1; k < k_analytic_bumps; ++k) sum += bump(q + k * k_bump_numbers, phi, c, sigma);
  return sum;
}

/// `q`: width, shift, knee.
template <class T>
T longitudinal(const T* q, double theta_i, double theta_o, double beta) {
  using std::cos, std::exp, std::sin, std::sqrt;
  const T variance = q[0] * q[0] * beta * beta, shifted = theta_o - q[1], signed_cosine = cos(shifted);
  const T cosine = signed_cosine < 0.0 ? T(-signed_cosine) : signed_cosine;  // past a pole it folds back
  const T across = std::cos(theta_i) - cosine, along = std::sin(theta_i) + sin(shifted);
  const T x = std::cos(theta_i) * cosine / variance;
  const T bessel = 1.0 / sqrt(1.0 + 2 * k_pi * x * (x + q[2] / k_pi) / (x + q[2]));
  return bessel * exp(-0.5 * (across * across + along * along) / variance) / (variance * (1.0 - exp(-2.0 / variance)));
}

/// A place, what the model says there, and what an error counts.
struct Sample {
  double a, b, c, value, weight;
};

struct NumbersOfN {
  Sample at;
  template <class T>
  bool operator()(const T* q, T* residual) const {
    residual[0] = at.weight * (bumps(q, at.a, at.b, at.c) - at.value);
    return true;
  }
};
struct NumbersOfM {
  Sample at;
  template <class T>
  bool operator()(const T* q, T* residual) const {
    residual[0] = at.weight * (longitudinal(q, at.a, at.b, at.c) - at.value);
    return true;
  }
};

/// Draws a number toward where it began: what the samples leave open must not run away between them.
struct Tether {
  int index;
  double start;
  template <class T>
  bool operator()(const T* q, T* residual) const {
    residual[0] = 0.02 * (q[index] - start);
    return true;
  }
};

template <class Cost, int k_count>
double solve(const std::vector<Sample>& samples, double* numbers) {
  ceres::Problem problem;
  for (int i = 0; i < k_count; ++i)
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Tether, 1, k_count>(new Tether{i, numbers[i]}), nullptr,
                             numbers);
  for (const Sample& sample : samples)
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Cost, 1, k_count>(new Cost{sample}), nullptr, numbers);
  if (std::is_same_v<Cost, NumbersOfM>) {
    problem.SetParameterLowerBound(numbers, 0, 0.05);  // the width
    problem.SetParameterLowerBound(numbers, 2, 0.05);  // the knee
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 150;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.final_cost;
}

/// Every absorption counts alike: weights are one over the rms of its samples.
void weigh(std::vector<Sample>& samples) {
  std::map<double, std::pair<double, double>> squares;
  for (const Sample& s : samples) {
    squares[s.c].first += s.value * s.value;
    squares[s.c].second += 1;
  }
  for (Sample& s : samples) s.weight = 1 / std::sqrt(std::max(squares[s.c].first / squares[s.c].second, 1e-30));
}

struct Fitter {
  const bsdf::Model& model;
  registry::ParameterValues values;
  std::string roughness;

  /// N on a grid for three absorptions.
  Result<void> add_n(int lobe, glm::dvec3 sigmas, int columns, int rows, std::vector<Sample>& out) {
    values.set("sigma_a", sigmas);
    std::vector<bsdf::Point> points;
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        points.push_back({0, 0, std::acos(k_lowest_cosine + (1 - k_lowest_cosine) * (y + 0.5) / rows),
                          k_pi * (x + 0.5) / columns, 0, 0});
    std::vector<glm::dvec3> n(points.size());
    CUTICLE_TRY(bsdf::evaluate(model, values, bsdf::Precision::f64, {bsdf::Quantity::N, lobe, points}, n));
    for (std::size_t i = 0; i < n.size(); ++i)
      for (int c = 0; c < 3; ++c) out.push_back({points[i].phi, std::cos(points[i].theta_d), sigmas[c], n[i][c], 1});
    return {};
  }
  /// M on a grid of the inclinations within 80 degrees, for one beta.
  Result<void> add_m(int lobe, double beta, int count, std::vector<Sample>& out) {
    values.set(roughness, beta);
    std::vector<bsdf::Point> points;
    for (int y = 0; y < count; ++y)
      for (int x = 0; x < count; ++x)
        points.push_back(
            {k_pi / 2.25 * (2 * (x + 0.5) / count - 1), k_pi / 2.25 * (2 * (y + 0.5) / count - 1), 0, 0, 0, 0});
    std::vector<glm::dvec3> m(points.size());
    CUTICLE_TRY(bsdf::evaluate(model, values, bsdf::Precision::f64, {bsdf::Quantity::M, lobe, points}, m));
    for (std::size_t i = 0; i < m.size(); ++i) out.push_back({points[i].theta_i, points[i].theta_o, beta, m[i].x, 1});
    return {};
  }
};

/// Where the search begins: R and TRT from phi = 0, TT from pi; a narrow bump and a wide one.
std::array<double, k_numbers> start_of_n(std::string_view lobe, double narrow) {
  std::array<double, k_numbers> q{};
  for (int k = 0; k < k_analytic_bumps; ++k) {
    double* bump = q.data() + k * k_bump_numbers;
    bump[0] = -1.5 - k;
    bump[3] = lobe == "R" ? 0 : lobe == "TT" ? 1 : 2;
    bump[6] = lobe == "TT" ? 3.1 : k == 0 ? 0.3 : 1;
    bump[9] = std::log(k == 0 ? narrow : 1.0);
  }
  return q;
}

template <class Value>
AnalyticError error_of(const std::vector<Sample>& samples, const Value& value) {
  double squares = 0, signal = 0, largest = 0, peak = 0;
  for (const Sample& s : samples) {
    const double off = std::abs(value(s) - s.value);
    squares += off * off;
    signal += s.value * s.value;
    largest = std::max(largest, off);
    peak = std::max(peak, std::abs(s.value));
  }
  return {std::sqrt(squares / signal), largest / peak};
}

Result<void> fit_n(Fitter& fitter, int lobe, AnalyticLobe& result) {
  std::vector<Sample> samples, others;
  for (const glm::dvec3 sigmas : {glm::dvec3(0, 0.1, 0.3), glm::dvec3(0.6, 1, 2)})
    CUTICLE_TRY(fitter.add_n(lobe, sigmas, 48, 10, samples));
  weigh(samples);
  double lowest = -1;
  for (double narrow : {0.15, 0.3, 0.6}) {
    std::array<double, k_numbers> numbers = start_of_n(result.name, narrow);
    const double cost = solve<NumbersOfN, k_numbers>(samples, numbers.data());
    if (lowest >= 0 && !(cost < lowest)) continue;
    lowest = cost;
    result.bumps = numbers;
  }
  CUTICLE_TRY(fitter.add_n(lobe, {0.05, 0.2, 0.8}, 101, 23, others));
  result.n = error_of(others, [&](const Sample& s) { return analytic_n(result, s.a, s.b, s.c); });
  return {};
}

Result<void> fit_m(Fitter& fitter, int lobe, double beta, AnalyticLobe& result) {
  std::vector<Sample> samples, others;
  for (double factor : {0.5, 1.0, 2.0}) CUTICLE_TRY(fitter.add_m(lobe, beta * factor, 31, samples));
  weigh(samples);
  double numbers[3] = {result.name == "TT" ? 0.5 : result.name == "TRT" ? 2.0 : 1.0, 0, 0.5};
  solve<NumbersOfM, 3>(samples, numbers);
  result.width = std::abs(numbers[0]);
  result.shift = numbers[1];
  result.knee = numbers[2];
  for (double factor : {0.6, 1.5}) CUTICLE_TRY(fitter.add_m(lobe, beta * factor, 73, others));
  result.m = error_of(others, [&](const Sample& s) { return analytic_m(result, s.a, s.b, s.c); });
  return {};
}

/// The name of the model's parameter that is the deviation of R in theta_i.
Result<std::string> roughness_of(const bsdf::Model& model, const registry::ParameterValues& values) {
  const auto has = [&](std::string_view name) {
    return std::ranges::find(model.entry.parameters, name, &registry::Parameter::name) != model.entry.parameters.end();
  };
  const bool near = model.near_field && model.near_field(values);
  const bool lobes =
      model.lobes.size() >= 3 && model.lobes[0] == "R" && model.lobes[1] == "TT" && model.lobes[2] == "TRT";
  const bool deviation = model.conventions.roughness.find("deviation") != std::string_view::npos;
  if (!near && lobes && deviation && has("sigma_a") && (has("beta") || has("beta_m")))
    return std::string(has("beta") ? "beta" : "beta_m");
  return usage_error(
      fmt::format("--fit analytic: {} has no M and N of R, TT and TRT with sigma_a and beta", model.entry.name),
      "--model deon or --model marschner");
}

}  // namespace

double analytic_n(const AnalyticLobe& lobe, double phi, double cos_theta_d, double sigma_a) {
  return bumps(lobe.bumps.data(), phi, cos_theta_d, sigma_a);
}

double analytic_m(const AnalyticLobe& lobe, double theta_i, double theta_o, double beta) {
  const double numbers[3] = {lobe.width, lobe.shift, lobe.knee};
  return longitudinal(numbers, theta_i, theta_o, beta);
}

Result<AnalyticFit> fit_analytic(const bsdf::Model& model, const registry::ParameterValues& values,
                                 Progress& progress) {
  CUTICLE_ASSIGN(const std::string roughness, roughness_of(model, values));
  AnalyticFit fit{&model, values, roughness, {}};
  for (int lobe = 0; lobe < 3; ++lobe) {
    progress.update("fit", std::size_t(lobe), 3);
    AnalyticLobe& result = fit.lobes.emplace_back();
    result.name = model.lobes[std::size_t(lobe)];
    Fitter fitter{model, values, roughness};
    CUTICLE_TRY(fit_n(fitter, lobe, result));
    CUTICLE_TRY(fit_m(fitter, lobe, values.real(roughness), result));
  }
  progress.update("fit", 3, 3);
  return fit;
}

}  // namespace cuticle::lut
