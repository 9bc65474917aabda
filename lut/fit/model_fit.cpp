#include "lut/fit/model_fit.h"

#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <boost/math/distributions/students_t.hpp>

#include "lut/fit/detail/identify.h"
#include "lut/fit/detail/tangents.h"

namespace cuticle::lut {
namespace {

/// The fit's state: the residuals of all numbers and their derivatives for one set of parameters, which Ceres' residual
/// blocks read.
class Equations final : public ceres::EvaluationCallback {
 public:
  /// `jet`: null, where the request asks for differences.
  Equations(const FitRequest& request, const Measurements& measurements, const JetModel* jet,
            std::vector<FreeParameter> free)
      : request_(request), measurements_(measurements), jet_(jet), free_(std::move(free)) {
    for (const FreeParameter& parameter : free_) x.push_back(parameter.get(request.start));
    weights_.assign(numbers(), 1.0);
    for (std::size_t k = 0; measurements.sigma_known && k < numbers(); ++k)
      weights_[k] = 1 / measurements.rows[k / channels()].sigma;
  }
  void PrepareForEvaluation(bool jacobians, bool new_point) override {
    if (new_point || residuals.empty() || (jacobians && !sloped_)) evaluate(jacobians);
  }
  /// Differences are left out where nobody asks for derivatives.
  void evaluate(bool sloped = true) {
    sloped_ = sloped || jet_;
    Tangents tangents = jet_ ? evaluate_tangents(*jet_, values(), free_, measurements_)
                             : difference_tangents(*request_.model, values(), free_, measurements_, sloped_);
    if (measurements_.relative) apply_scale(tangents);
    residuals.resize(numbers());
    gradients.resize(numbers() * free_.size());
    for (std::size_t k = 0; k < numbers(); ++k) {
      const std::size_t row = k / channels(), c = k % channels();
      residuals[k] = weights_[k] * (tangents.values[row][int(c)] - measurements_.rows[row].value[int(c)]);
      for (std::size_t j = 0; j < free_.size(); ++j)
        gradients[k * free_.size() + j] = weights_[k] * tangents.gradients[(3 * row + c) * free_.size() + j];
    }
  }
  /// Divides the residuals by their scale from now on.
  void rescale(double scale) {
    for (double& weight : weights_) weight /= scale;
    evaluate();
  }
  registry::ParameterValues values() const {
    registry::ParameterValues values = request_.start;
    for (std::size_t j = 0; j < free_.size(); ++j) free_[j].set(values, x[j]);
    return values;
  }
  std::size_t channels() const { return measurements_.one_number ? 1 : 3; }
  std::size_t numbers() const { return measurements_.rows.size() * channels(); }
  const std::vector<FreeParameter>& free() const { return free_; }

  double scale() const { return scale_; }

  std::vector<double> x, residuals, gradients;

 private:
  /// Multiplies the model by the factor s = sum w^2 m v / sum w^2 m^2 of least squares, with what it adds to the
  /// derivatives (variable projection, Golub and Pereyra 1973).
  void apply_scale(Tangents& tangents) {
    const std::size_t count = free_.size();
    double across = 0, square = 0;
    std::vector<double> slope_across(count), slope_square(count);
    for_each_number(tangents, [&](double weight, double model, double measured, const double* slope) {
      across += weight * model * measured;
      square += weight * model * model;
      for (std::size_t j = 0; j < count; ++j) {
        slope_across[j] += weight * measured * slope[j];
        slope_square[j] += 2 * weight * model * slope[j];
      }
    });
    scale_ = square > 0 ? across / square : 1;
    for (std::size_t k = 0; k < numbers(); ++k) {
      const std::size_t row = k / channels(), c = k % channels();
      double& value = tangents.values[row][int(c)];
      for (std::size_t j = 0; j < count; ++j) {
        const double of_scale = square > 0 ? (slope_across[j] - scale_ * slope_square[j]) / square : 0;
        double& slope = tangents.gradients[(3 * row + c) * count + j];
        slope = scale_ * slope + of_scale * value;
      }
      value *= scale_;
    }
  }
  template <class Visit>
  void for_each_number(const Tangents& tangents, const Visit& visit) const {
    for (std::size_t k = 0; k < numbers(); ++k) {
      const std::size_t row = k / channels(), c = k % channels();
      visit(weights_[k] * weights_[k], tangents.values[row][int(c)], measurements_.rows[row].value[int(c)],
            tangents.gradients.data() + (3 * row + c) * free_.size());
    }
  }

  const FitRequest& request_;
  const Measurements& measurements_;
  const JetModel* jet_;
  std::vector<FreeParameter> free_;
  std::vector<double> weights_;
  bool sloped_ = false;  ///< whether the derivatives are those of x
  double scale_ = 1;     ///< of relative measurements
};

/// One number's residual, read from the equations.
class NumberCost final : public ceres::CostFunction {
 public:
  NumberCost(const Equations& equations, std::size_t number) : equations_(equations), number_(number) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(int(equations.free().size()));
  }
  bool Evaluate(const double* const*, double* residuals, double** jacobians) const override {
    residuals[0] = equations_.residuals[number_];
    const std::size_t count = equations_.free().size();
    if (jacobians && jacobians[0]) std::copy_n(equations_.gradients.data() + number_ * count, count, jacobians[0]);
    return true;
  }

 private:
  const Equations& equations_;
  std::size_t number_;
};

std::unique_ptr<ceres::LossFunction> make_loss(Loss loss) {
  if (loss == Loss::huber) return std::make_unique<ceres::HuberLoss>(k_huber_at);
  if (loss == Loss::cauchy) return std::make_unique<ceres::CauchyLoss>(k_cauchy_at);
  return nullptr;
}

ceres::Solver::Options solver_options(double least_change) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = least_change > 1e-9 ? 15 : 200;
  options.function_tolerance = least_change;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-11;
  options.logging_type = ceres::SILENT;
  return options;
}

bool solve(Equations& equations, Loss loss, double least_change) {
  const std::unique_ptr<ceres::LossFunction> loss_function = make_loss(loss);
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &equations;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  for (std::size_t k = 0; k < equations.numbers(); ++k)
    problem.AddResidualBlock(new NumberCost(equations, k), loss_function.get(), equations.x.data());
  for (std::size_t j = 0; j < equations.x.size(); ++j) {
    problem.SetParameterLowerBound(equations.x.data(), int(j), equations.free()[j].parameter->minimum);
    problem.SetParameterUpperBound(equations.x.data(), int(j), equations.free()[j].parameter->maximum);
  }
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(least_change), &problem, &summary);
  equations.evaluate();
  return summary.termination_type == ceres::CONVERGENCE;
}

double root_mean_square(const std::vector<double>& numbers) {
  double sum = 0;
  for (double number : numbers) sum += number * number;
  return std::sqrt(sum / double(numbers.size()));
}

/// A standard deviation that outliers do not move: 1.4826 times the median of the residuals' absolute values.
double robust_scale(std::vector<double> residuals) {
  for (double& residual : residuals) residual = std::abs(residual);
  const auto middle = residuals.begin() + std::ptrdiff_t(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return std::max(1.4826 * *middle, 1e-12);
}

/// Twice the cost of the residuals: chi squared, or what a robust loss makes of it.
double deviance(const std::vector<double>& residuals, Loss loss) {
  const std::unique_ptr<ceres::LossFunction> function = make_loss(loss);
  double sum = 0;
  for (double residual : residuals) {
    double rho[3] = {residual * residual, 1, 0};
    if (function) function->Evaluate(residual * residual, rho);
    sum += rho[0];
  }
  return sum;
}

/// Akaike's criterion without what all models of the same data share; an unknown noise is one more parameter.
double akaike(const Equations& equations, Loss loss, const Measurements& measurements, double scale) {
  const double parameters = double(equations.x.size() + measurements.relative), numbers = double(equations.numbers());
  const double chi = deviance(equations.residuals, loss);
  if (measurements.sigma_known) return chi + 2 * parameters;
  return numbers * std::log(std::max(chi, 1e-300) * scale * scale / numbers) + 2 * (parameters + 1);
}

Result<void> check_rows(const FitRequest& request, const Measurements& measurements) {
  std::vector<bsdf::Point> points;
  for (const Observation& row : measurements.rows) {
    points.push_back(row.point);
    CUTICLE_TRY(check_request(*request.model, {measurements.quantity, row.lobe, std::span(&row.point, 1)}, 1));
    if (measurements.sigma_known && !(row.sigma > 0))
      return bad_input(fmt::format("row {}: sigma {} is not positive", points.size(), row.sigma));
  }
  return {};
}

Result<void> check_counts(const Equations& equations) {
  if (equations.free().empty()) return usage_error("--free: no parameter is free");
  if (equations.numbers() > equations.free().size()) return {};
  return usage_error(fmt::format("{} numbers cannot fix {} parameters", equations.numbers(), equations.free().size()),
                     "more rows, or fewer names after --free");
}

/// Noise of the residuals in their units: 1 where it is known.
double noise_of(const Equations& equations, bool sigma_known, Loss loss) {
  if (sigma_known && loss == Loss::squares) return 1;
  return robust_noise(equations.residuals, equations.x.size(), loss);
}

ModelFit summarise(const FitRequest& request, const Measurements& measurements, const Equations& equations,
                   double scale) {
  ModelFit fit;
  fit.model = request.model;
  fit.values = equations.values();
  const double noise = noise_of(equations, measurements.sigma_known, request.loss);
  fit.scale = equations.scale();
  fit.numbers = equations.numbers();
  fit.residual = root_mean_square(equations.residuals) * scale;
  fit.aic = akaike(equations, request.loss, measurements, scale);
  if (!measurements.sigma_known) {
    const boost::math::students_t student(double(fit.numbers - equations.x.size()));
    fit.interval = boost::math::quantile(student, 0.975);
  }
  describe(equations.free(), equations.x, equations.gradients, noise, fit);
  return fit;
}

}  // namespace

Result<Loss> find_loss(std::string_view name) {
  if (name == "squares") return Loss::squares;
  if (name == "huber") return Loss::huber;
  if (name == "cauchy") return Loss::cauchy;
  return usage_error(fmt::format("--loss: '{}' is not one of squares, huber, cauchy", name));
}

Result<ModelFit> fit_model(const FitRequest& request, const Measurements& measurements) {
  const JetModel* jet = nullptr;
  if (!request.by_differences) {
    CUTICLE_ASSIGN(jet, find_jet_model(*request.model));
  }
  CUTICLE_ASSIGN(std::vector<FreeParameter> free,
                 free_parameters(*request.model, request.free, measurements.one_number));
  CUTICLE_TRY(check_rows(request, measurements));
  Equations equations(request, measurements, jet, std::move(free));
  CUTICLE_TRY(check_counts(equations));
  bool converged = solve(equations, Loss::squares, request.least_change);
  double scale = 1;
  if (request.loss != Loss::squares) {
    scale = measurements.sigma_known ? 1 : robust_scale(equations.residuals);
    equations.rescale(scale);
    converged = solve(equations, request.loss, request.least_change);
  }
  ModelFit fit = summarise(request, measurements, equations, scale);
  fit.converged = converged;
  return fit;
}

Json to_json(const ModelFit& fit) {
  Json json{{"model", fit.model->entry.name},
            {"numbers", fit.numbers},
            {"converged", fit.converged},
            {"residual", fit.residual},
            {"aic", fit.aic},
            {"scale", fit.scale},
            {"inseparable", fit.inseparable},
            {"parameters", Json::list()}};
  if (!fit.inseparable.empty()) return json;
  for (const FittedParameter& p : fit.parameters)
    json["parameters"].push_back({{"name", p.name},
                                  {"value", p.value},
                                  {"sigma", p.sigma},
                                  {"interval_95", {p.value - fit.interval * p.sigma, p.value + fit.interval * p.sigma}},
                                  {"at_bound", p.at_bound}});
  json["correlations"] = fit.correlations;
  json["settings"] = Json::parse(registry::to_json(fit.values)).value();
  return json;
}

}  // namespace cuticle::lut
