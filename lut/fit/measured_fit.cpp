#include "lut/fit/measured_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bsdf/fibre/fibres.h"
#include "lut/fit/detail/jet_model.h"

namespace cuticle::lut {
namespace {

constexpr std::size_t k_slow = 120;  ///< directions at most that models are fitted to by differences
constexpr std::size_t k_few = 60;    ///< directions that choose among the starts

/// Whether the model's values, twice a parameter, cost less than its derivatives, or it has none: chiang's far field is
/// an adaptive integral, which vectors of derivatives make longer.
bool by_differences(const bsdf::Model& model) {
  return model.entry.name == "chiang" ||
         std::ranges::none_of(jet_models(), [&](const JetModel& jet) { return jet.name == model.entry.name; });
}

/// The model's parameters with quadratures as exact as measurements, or differences of their values, ask for.
Result<registry::ParameterValues> quick_settings(const bsdf::Model& model, const std::string& preset,
                                                 const std::string& settings) {
  std::string all;
  for (const registry::Parameter& parameter : model.entry.parameters)
    if (parameter.name.find("tolerance") != std::string_view::npos)
      all = fmt::format("{}={}", parameter.name, by_differences(model) ? 1e-4 : 1e-2);
  if (!all.empty() && !settings.empty()) all += ",";
  return bsdf::parse_settings(model, preset,
                              settings.find("tolerance") == std::string::npos ? all + settings : settings);
}

/// Where every step costs two evaluations a parameter: blond and brown alone.
Result<std::vector<registry::ParameterValues>> few_starts(const bsdf::Model& model) {
  std::vector<registry::ParameterValues> starts;
  for (const char* name : {"blond", "brown"}) {
    CUTICLE_ASSIGN(const bsdf::NamedFibre named, bsdf::find_fibre(name));
    CUTICLE_ASSIGN(starts.emplace_back(), quick_settings(model, "", model.from_fibre(named.fibre).settings));
  }
  return starts;
}

/// Where searches begin: several fibres in the model's own parameters, or what the caller gives.
Result<std::vector<registry::ParameterValues>> starts_of(const MeasuredFitRequest& request) {
  std::vector<registry::ParameterValues> starts;
  const bsdf::Model& model = *request.model;
  if (!request.preset.empty() || !request.settings.empty() || !model.from_fibre) {
    CUTICLE_ASSIGN(starts.emplace_back(), quick_settings(model, request.preset, request.settings));
    return starts;
  }
  if (by_differences(model)) return few_starts(model);
  for (const char* name : {"blond", "brown", "black", "fur_brown"})
    for (const double deviation : {0.1, 0.25}) {
      CUTICLE_ASSIGN(bsdf::NamedFibre named, bsdf::find_fibre(name));
      if (named.fibre.medulla_ratio > 0 && model.entry.name != "yan_fur") continue;
      named.fibre.longitudinal_deviation = named.fibre.azimuthal_deviation = deviation;
      CUTICLE_ASSIGN(starts.emplace_back(), quick_settings(model, "", model.from_fibre(named.fibre).settings));
    }
  return starts;
}

Observation observation_of(const bsdf::MeasuredDirection& at) {
  return {{.theta_i = at.theta_i, .theta_o = at.theta_o, .theta_d = (at.theta_o - at.theta_i) / 2, .phi = at.phi},
          -1,
          at.value,
          at.sigma};
}

Measurements fitted_half(const bsdf::MeasuredFibre& fibre, std::size_t most) {
  Measurements half;
  half.one_number = fibre.one_number;
  half.sigma_known = fibre.sigma_known;
  half.relative = true;
  const std::size_t stride = (fibre.directions.size() / 2 + most - 1) / std::max<std::size_t>(most, 1);
  for (std::size_t i = 0; i < fibre.directions.size(); ++i)
    if (fits(i) && i / 2 % std::max<std::size_t>(stride, 1) == 0)
      half.rows.push_back(observation_of(fibre.directions[i]));
  return half;
}

/// The fit without the parameters that these data cannot tell, which stay where they began.
Result<ModelFit> told_fit(FitRequest request, const Measurements& half) {
  CUTICLE_ASSIGN(ModelFit fit, fit_model(request, half));
  while (!fit.inseparable.empty() && request.free.size() > 1) {
    const std::string& last = fit.inseparable.front().back();
    std::erase_if(request.free, [&](const std::string& name) { return last == name || last.starts_with(name + "."); });
    if (request.free.empty()) break;
    CUTICLE_ASSIGN(fit, fit_model(request, half));
  }
  return fit;
}

/// The best fit to a few directions from all starts, and from there to all of them.
Result<std::optional<ModelFit>> best_fit(const MeasuredFitRequest& request, const std::vector<std::string>& free,
                                         const bsdf::MeasuredFibre& fibre) {
  CUTICLE_ASSIGN(const std::vector<registry::ParameterValues> starts, starts_of(request));
  const bool differences = by_differences(*request.model);
  constexpr double change = 1e-5;
  std::optional<ModelFit> best;
  for (const registry::ParameterValues& start : starts) {
    CUTICLE_ASSIGN(ModelFit fit, told_fit({request.model, start, free, request.loss, differences, change},
                                          fitted_half(fibre, std::min(request.most_directions, k_few))));
    if (std::isfinite(fit.residual) && fit.inseparable.empty() && fit.scale > 0 &&
        (!best || fit.residual < best->residual))
      best = std::move(fit);
  }
  if (!best) return best;
  CUTICLE_ASSIGN(best, told_fit({request.model, best->values, free, request.loss, differences, change},
                                fitted_half(fibre, differences ? std::min(request.most_directions, k_slow)
                                                               : request.most_directions)));
  return best;
}

Result<std::vector<glm::dvec3>> predictions(const ModelFit& fit, const bsdf::MeasuredFibre& fibre) {
  std::vector<bsdf::Point> points;
  for (const bsdf::MeasuredDirection& at : fibre.directions) points.push_back(observation_of(at).point);
  std::vector<glm::dvec3> values(points.size());
  CUTICLE_TRY(bsdf::evaluate(*fit.model, fit.values, bsdf::Precision::f64, {bsdf::Quantity::S, -1, points}, values));
  for (glm::dvec3& value : values) value *= fit.scale;
  return values;
}

template <class Counts>
double error_where(const MeasuredModel& model, const bsdf::MeasuredFibre& fibre, const Counts& counts) {
  double off = 0, all = 0;
  for (std::size_t i = 0; i < fibre.directions.size(); ++i) {
    if (fits(i) || !counts(fibre.directions[i])) continue;
    for (int c = 0; c < (fibre.one_number ? 1 : 3); ++c) {
      const double measured = fibre.directions[i].value[c], difference = model.predicted[i][c] - measured;
      off += difference * difference;
      all += measured * measured;
    }
  }
  return all > 0 ? std::sqrt(off / all) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

LobeZone zone_of(const bsdf::MeasuredDirection& direction) {
  const double phi = std::remainder(direction.phi, 2 * std::numbers::pi);
  if (std::abs(phi) > 2 * std::numbers::pi / 3) return LobeZone::tt;
  return direction.theta_i + direction.theta_o < 0 ? LobeZone::r : LobeZone::trt;
}

Result<MeasuredModel> fit_measured(const MeasuredFitRequest& request, const bsdf::MeasuredFibre& fibre) {
  if (fibre.directions.size() < 8)
    return bad_input(fmt::format("{} measured directions; a fit that is judged needs 8", fibre.directions.size()));
  std::vector<std::string> free = request.free;
  if (free.empty()) free.assign(request.model->measurable.begin(), request.model->measurable.end());
  if (free.empty())
    return usage_error(fmt::format("{}: no parameters are known to be measurable", request.model->entry.name),
                       "name them with --free");
  CUTICLE_ASSIGN(std::optional<ModelFit> best, best_fit(request, free, fibre));
  if (!best)
    return bad_input(fmt::format("{}: these data tell none of {}", request.model->entry.name, fmt::join(free, ", ")));
  MeasuredModel model{std::move(*best), {}};
  CUTICLE_ASSIGN(model.predicted, predictions(model.fit, fibre));
  return model;
}

double judged_error(const MeasuredModel& model, const bsdf::MeasuredFibre& fibre) {
  return error_where(model, fibre, [](const bsdf::MeasuredDirection&) { return true; });
}
double judged_error(const MeasuredModel& model, const bsdf::MeasuredFibre& fibre, LobeZone zone) {
  return error_where(model, fibre, [&](const bsdf::MeasuredDirection& at) { return zone_of(at) == zone; });
}

}  // namespace cuticle::lut
