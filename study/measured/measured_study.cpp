#include "study/measured/measured_study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "bsdf/fibre/fibres.h"
#include "core/file.h"
#include "lut/fit/measured_fit.h"

namespace cuticle::study {
namespace {

using lut::LobeZone;
using lut::MeasuredModel;

constexpr double k_far = 4;         ///< times the best one's error: farther models are not drawn
constexpr std::size_t k_shown = 5;  ///< models beside the measurement in a plot
constexpr double k_degrees = 180 / std::numbers::pi;

Result<std::vector<const bsdf::Model*>> models_of(const MeasuredRequest& request) {
  if (request.models.empty()) return std::vector<const bsdf::Model*>(bsdf::models().begin(), bsdf::models().end());
  std::vector<const bsdf::Model*> chosen;
  for (const std::string& name : request.models) {
    CUTICLE_ASSIGN(chosen.emplace_back(), bsdf::find_model(name));
  }
  return chosen;
}

Result<bsdf::MeasuredFibre> measurement_of(const MeasuredRequest& request) {
  if (!request.file.empty()) return bsdf::read_measured(request.file, request.format, request.gantry);
  CUTICLE_ASSIGN(const bsdf::NamedFibre hair, bsdf::find_fibre(request.hair));
  const std::string text = synthetic_measurement(hair.fibre, request.gantry, request.walks);
  if (!request.write.empty()) CUTICLE_TRY(write_text_file(request.write, text));
  return bsdf::parse_gantry(text, "synthetic", request.gantry);
}

/// Green, or the one number.
double shown(const glm::dvec3& value) { return value.y; }

/// Differences of the judging directions over the root of the mean square of what was measured there; NaN outside the
/// zone.
template <class Counts>
std::vector<double> errors_where(const MeasuredModel& model, const bsdf::MeasuredFibre& fibre, const Counts& counts) {
  std::vector<double> errors;
  double square = 0, number = 0;
  for (std::size_t i = 0; i < fibre.directions.size(); ++i) {
    if (lut::fits(i)) continue;
    const bool counted = counts(fibre.directions[i]);
    const double measured = shown(fibre.directions[i].value);
    errors.push_back(counted ? shown(model.predicted[i]) - measured : std::numeric_limits<double>::quiet_NaN());
    square += counted ? measured * measured : 0;
    number += counted;
  }
  const double scale = square > 0 ? std::sqrt(square / number) : 1;
  for (double& error : errors) error /= scale;
  return errors;
}

Measured judged(const MeasuredModel& model, const bsdf::MeasuredFibre& fibre) {
  Measured measured;
  measured.errors.push_back(errors_where(model, fibre, [](const bsdf::MeasuredDirection&) { return true; }));
  for (const LobeZone zone : {LobeZone::r, LobeZone::tt, LobeZone::trt})
    measured.errors.push_back(
        errors_where(model, fibre, [zone](const bsdf::MeasuredDirection& at) { return lut::zone_of(at) == zone; }));
  return measured;
}

Work one_direction(const MeasuredModel& model, const bsdf::MeasuredFibre& fibre) {
  constexpr std::size_t most = 16;
  const auto points = std::make_shared<std::vector<bsdf::Point>>();
  for (std::size_t i = 0; i < fibre.directions.size() && i < most; ++i)
    points->push_back({.theta_i = fibre.directions[i].theta_i,
                       .theta_o = fibre.directions[i].theta_o,
                       .phi = fibre.directions[i].phi});
  const auto out = std::make_shared<std::vector<glm::dvec3>>(points->size());
  return {{},
          [fit = model.fit, points, out]() -> Result<void> {
            fit.model->evaluate_f32(fit.values, {bsdf::Quantity::S, -1, *points}, *out);
            return {};
          },
          double(points->size())};
}

Group empty_group(const bsdf::MeasuredFibre& fibre) {
  return {.name = "models",
          .title = "Models that one half of the directions fitted, beside the other half",
          .truth = fmt::format(
              "{} measured directions, every second one; each model fitted up to a factor on the {} others. TT: phi "
              "farther than 120 degrees from back toward the light; of the rest R: theta_i + theta_o < 0, TRT: above",
              fibre.directions.size() / 2, fibre.directions.size() - fibre.directions.size() / 2),
          .metrics = {{"S", "rms error over rms", "1", Mean::root_mean_square},
                      {"R", "the same where R is", "1", Mean::root_mean_square},
                      {"TT", "the same where TT is", "1", Mean::root_mean_square},
                      {"TRT", "the same where TRT is", "1", Mean::root_mean_square}},
          .item = "direction"};
}

std::string parameters_of(const lut::ModelFit& fit) {
  std::string text;
  for (const lut::FittedParameter& p : fit.parameters)
    text += fmt::format("{}{} {:.3g} ± {:.1g}{}", text.empty() ? "" : ", ", p.name, p.value, fit.interval * p.sigma,
                        p.at_bound ? " (end of its range)" : "");
  return text;
}

Table fit_table(const std::vector<MeasuredModel>& models, const bsdf::MeasuredFibre& fibre) {
  Table table{
      "fits",
      "What was found: error of the judging half over all, and where R, TT and TRT are; parameters with 95 % intervals",
      {"model", "all", "R", "TT", "TRT", "factor", "parameters"},
      {}};
  for (const MeasuredModel& model : models) {
    std::vector<std::string> row = {std::string(model.fit.model->entry.name),
                                    fmt::format("{:.3f}", lut::judged_error(model, fibre))};
    for (const LobeZone zone : {LobeZone::r, LobeZone::tt, LobeZone::trt})
      row.push_back(fmt::format("{:.3f}", lut::judged_error(model, fibre, zone)));
    row.push_back(fmt::format("{:.3g}", model.fit.scale));
    row.push_back(parameters_of(model.fit));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Angles of a direction, in whole millionths of a degree, so that equal ones are found.
long long key(double radians) { return std::llround(radians * k_degrees * 1e6); }

/// A cut: directions that share two angles, over the third.
struct Cut {
  std::string name, title, x_label;
  std::vector<std::size_t> directions;
  double bsdf::MeasuredDirection::*along;
};

/// Of all directions that share the two angles those with the smallest `distance`, in the order of `along`.
template <class Distance>
std::vector<std::size_t> nearest_cut(const bsdf::MeasuredFibre& fibre, double bsdf::MeasuredDirection::*first,
                                     double bsdf::MeasuredDirection::*second, double bsdf::MeasuredDirection::*along,
                                     const Distance& distance) {
  std::map<std::pair<long long, long long>, std::vector<std::size_t>> cuts;
  for (std::size_t i = 0; i < fibre.directions.size(); ++i)
    cuts[{key(fibre.directions[i].*first), key(fibre.directions[i].*second)}].push_back(i);
  std::vector<std::size_t> best;
  for (auto& [at, cut] : cuts)
    if (cut.size() >= 4 && (best.empty() || distance(fibre.directions[cut[0]]) < distance(fibre.directions[best[0]])))
      best = cut;
  std::ranges::sort(best, {}, [&](std::size_t i) { return fibre.directions[i].*along; });
  return best;
}

std::vector<Cut> cuts_of(const bsdf::MeasuredFibre& fibre) {
  using Direction = bsdf::MeasuredDirection;
  const auto off_azimuth = [](double phi) {
    return [phi](const Direction& at) { return std::abs(std::remainder(at.phi - phi, 2 * std::numbers::pi)); };
  };
  const auto off_mirror = [](const Direction& at) { return std::abs(at.theta_i + at.theta_o); };
  std::vector<Cut> cuts = {
      {"around", "around the fibre", "phi, degrees (0: back toward the light, 180: straight through)",
       nearest_cut(fibre, &Direction::theta_i, &Direction::theta_o, &Direction::phi, off_mirror), &Direction::phi},
      {"back", "along the fibre, on the light's side", "theta_i, degrees",
       nearest_cut(fibre, &Direction::phi, &Direction::theta_o, &Direction::theta_i, off_azimuth(0)),
       &Direction::theta_i},
      {"through", "along the fibre, on the far side", "theta_i, degrees",
       nearest_cut(fibre, &Direction::phi, &Direction::theta_o, &Direction::theta_i, off_azimuth(std::numbers::pi)),
       &Direction::theta_i}};
  std::erase_if(cuts, [](const Cut& cut) { return cut.directions.empty(); });
  return cuts;
}

double largest(const bsdf::MeasuredFibre& fibre) {
  double most = 0;
  for (const bsdf::MeasuredDirection& at : fibre.directions) most = std::max(most, shown(at.value));
  return most;
}

Plot plot_of(const Cut& cut, const bsdf::MeasuredFibre& fibre, const std::vector<const MeasuredModel*>& best) {
  const bsdf::MeasuredDirection& at = fibre.directions[cut.directions[0]];
  const std::string place =
      cut.name == "around"
          ? fmt::format("theta_i {:.0f}, theta_o {:.0f} degrees", at.theta_i * k_degrees, at.theta_o * k_degrees)
          : fmt::format("phi {:.0f}, theta_o {:.0f} degrees", at.phi * k_degrees, at.theta_o * k_degrees);
  Plot plot{cut.name,    fmt::format("Scattering {}: {}", cut.title, place),
            cut.x_label, cut.name == "around" ? "log10 of measured units" : "measured units",
            false,       false,
            {}};
  const double floor = 1e-4 * largest(fibre);
  const auto add = [&](const std::string& name, const auto& value) {
    Curve curve{name, {}, {}};
    for (const std::size_t i : cut.directions) {
      curve.x.push_back(fibre.directions[i].*cut.along * k_degrees);
      curve.y.push_back(cut.name == "around" ? std::log10(std::max(value(i), floor)) : value(i));
    }
    plot.curves.push_back(std::move(curve));
  };
  add("measurement", [&](std::size_t i) { return shown(fibre.directions[i].value); });
  for (const MeasuredModel* model : best)
    add(std::string(model->fit.model->entry.name), [&](std::size_t i) { return shown(model->predicted[i]); });
  return plot;
}

std::vector<const MeasuredModel*> best_models(const std::vector<MeasuredModel>& models,
                                              const bsdf::MeasuredFibre& fibre) {
  std::vector<const MeasuredModel*> best;
  for (const MeasuredModel& model : models) best.push_back(&model);
  std::ranges::sort(best, {}, [&](const MeasuredModel* model) { return lut::judged_error(*model, fibre); });
  best.resize(std::min(best.size(), k_shown));
  while (best.size() > 1 && lut::judged_error(*best.back(), fibre) > k_far * lut::judged_error(*best.front(), fibre))
    best.pop_back();
  return best;
}

Result<std::vector<MeasuredModel>> fit_all(const std::vector<const bsdf::Model*>& models,
                                           const bsdf::MeasuredFibre& fibre, Study& study, Progress& progress) {
  std::vector<MeasuredModel> fitted;
  for (std::size_t i = 0; i < models.size(); ++i) {
    progress.update("fits", i, models.size());
    auto model = lut::fit_measured({.model = models[i]}, fibre);
    if (model)
      fitted.push_back(std::move(*model));
    else
      study.notes.push_back(fmt::format("{}: left out: {}", models[i]->entry.name, model.error().message));
  }
  progress.update("fits", models.size(), models.size());
  return fitted;
}

std::string about(const MeasuredRequest& request, const bsdf::MeasuredFibre& fibre) {
  const std::string places =
      fmt::format("{} measured directions, {} named without a value", fibre.directions.size(), fibre.unmeasured);
  if (!request.file.empty()) return fmt::format("{}: {}.", request.file, places);
  return fmt::format(
      "No file was given: {} by {} walks through a rough {} fibre (study/oracle), written and read in the format of "
      "Yan et al. "
      "2015, which also gave it its noise. A model that were the fibre would find a factor of 1.",
      places, request.walks, request.hair);
}

}  // namespace

Result<Study> measured_study(const MeasuredRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const std::vector<const bsdf::Model*> models, models_of(request));
  CUTICLE_ASSIGN(const bsdf::MeasuredFibre fibre, measurement_of(request));
  Study study{.name = "measured",
              .title = request.file.empty()
                           ? fmt::format("Fibre models beside a synthetic measurement of {} hair", request.hair)
                           : fmt::format("Fibre models beside {}", request.file),
              .question = "Which fibre model predicts directions of a measured fibre that it was not fitted to?",
              .cost_label = "one evaluation of S, one thread"};
  study.notes.push_back(about(request, fibre));
  CUTICLE_ASSIGN(const std::vector<MeasuredModel> fitted, fit_all(models, fibre, study, progress));
  Group& group = study.groups.emplace_back(empty_group(fibre));
  for (const MeasuredModel& model : fitted)
    group.points.push_back({std::string(model.fit.model->entry.name),
                            {},
                            [model, fibre]() -> Result<Measured> { return judged(model, fibre); },
                            one_direction(model, fibre)});
  for (const Cut& cut : cuts_of(fibre)) study.plots.push_back(plot_of(cut, fibre, best_models(fitted, fibre)));
  study.tables.push_back(fit_table(fitted, fibre));
  CUTICLE_ASSIGN(const std::vector<Feature> features, published_features(request.walks / 4));
  study.tables.push_back(feature_table(features));
  return study;
}

}  // namespace cuticle::study
