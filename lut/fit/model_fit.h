#pragma once
// Parameters of a model from measured or simulated lobes.
#include <string>
#include <vector>

#include "bsdf/model.h"
#include "core/json/json.h"

namespace cuticle::lut {

/// One measured place: r, g, b of the quantity, or one number (see Measurements), with its standard deviation.
struct Observation {
  bsdf::Point point;  ///< radians
  int lobe = -1;      ///< index into the model's lobes, -1 = the sum
  glm::dvec3 value{0};
  double sigma = 0;  ///< of each number; read where Measurements::sigma_known
};
struct Measurements {
  bsdf::Quantity quantity = bsdf::Quantity::S;
  std::vector<Observation> rows;
  bool sigma_known = false;
  bool one_number = false;  ///< value.x alone; the model's colours are then grey
  bool relative = false;    ///< in units of their own: the model is compared up to a factor, the best one at every step
};

/// What one residual costs: its square, or Huber's or Cauchy's function of it, which outliers pull less.
enum class Loss { squares, huber, cauchy };
/// "squares", "huber", "cauchy". Error: usage, listing them.
Result<Loss> find_loss(std::string_view name);

struct FitRequest {
  const bsdf::Model* model = nullptr;
  registry::ParameterValues start;
  /// Names of real and rgb parameters; a component alone as "sigma_a.r".
  std::vector<std::string> free;
  Loss loss = Loss::squares;
  /// Of a model without derivatives of its own (huang): by central differences of its values, which cost two
  /// evaluations a parameter and stop the search where the values' own steps begin.
  bool by_differences = false;
  double least_change =
      1e-12;  ///< share of the cost that a step must take off for the search to go on; above 1e-9: 15 steps at most
};
struct FittedParameter {
  std::string name;  ///< "eta", "sigma_a.r"
  double value = 0;
  double sigma = 0;       ///< one standard deviation; 0 at a bound
  bool at_bound = false;  ///< the data pull it out of its range
};
struct ModelFit {
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;  ///< the start's, with the fitted ones
  std::vector<FittedParameter> parameters;
  std::vector<double> correlations;  ///< row by row, in the order of the parameters
  double interval = 1.96;  ///< standard deviations in half a 95 % interval (Student's where sigma is not known)
  double residual = 0;     ///< rms of the residuals; in units of sigma where that is known
  double scale = 1;        ///< that the model's values are multiplied by; 1 unless Measurements::relative
  std::size_t numbers = 0;
  double aic = 0;  ///< Akaike's criterion; comparable between models of the same measurements and loss
  /// Groups of parameters that the measurements cannot tell apart (a group of one: they do not depend on it). Not
  /// empty: the values mean nothing.
  std::vector<std::vector<std::string>> inseparable;
  bool converged = false;
};

/// Least squares (Ceres) within the parameters' ranges, with derivatives from the model's own formulas (ceres::Jet).
/// Measured: 95 % intervals hold the truth in 91 .. 98 % of 200 noisy sets (model_fit_test). Errors: usage, for a name
/// that is no real or rgb parameter, a model without derivatives (huang; see by_differences) or fewer numbers than
/// parameters; bad_input for a point out of range or a sigma that is not positive.
Result<ModelFit> fit_model(const FitRequest& request, const Measurements& measurements);

/// Names, values, sigma, 95 % intervals and correlations; of a fit that cannot tell parameters apart, which they are.
Json to_json(const ModelFit& fit);

}  // namespace cuticle::lut
