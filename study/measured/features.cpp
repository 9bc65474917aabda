// Published features of real fibres against what models and walks predict of a fibre of that kind.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bsdf/fibre/fibres.h"
#include "study/lobes/lobes_study.h"
#include "study/measured/measured_study.h"
#include "study/oracle/rough_fibre.h"

namespace cuticle::study {
namespace {

constexpr double k_degree = std::numbers::pi / 180;

/// Scales of 2.5 degrees, so smooth that lobes have a place; clear, index 1.55.
bsdf::Fibre smooth_fibre() {
  bsdf::Fibre fibre;
  fibre.sigma_a = glm::dvec3(0.1);
  fibre.scale_tilt = 2.5 * k_degree;
  fibre.longitudinal_deviation = fibre.azimuthal_deviation = 0.05;
  return fibre;
}

/// Where y is largest, between its neighbours by a parabola.
double peak_between(const std::vector<double>& x, const std::vector<double>& y) {
  const auto top = std::size_t(std::ranges::max_element(y) - y.begin());
  if (top == 0 || top + 1 == y.size()) return x[top];
  const double below = y[top - 1], above = y[top + 1], bend = below - 2 * y[top] + above;
  return x[top] + (bend < 0 ? (below - above) / (2 * bend) * (x[1] - x[0]) : 0);
}

/// |theta_o| of a lobe's peak in the plane of incidence, back toward the light.
Result<double> reflected(const bsdf::Model& model, const registry::ParameterValues& values, int lobe, double theta_i) {
  std::vector<bsdf::Point> points;
  std::vector<double> x, y;
  for (double degrees = 20; degrees <= 60; degrees += 0.25) {
    x.push_back(degrees);
    points.push_back({.theta_i = theta_i, .theta_o = -std::copysign(degrees * k_degree, theta_i), .phi = 0});
  }
  std::vector<glm::dvec3> out(points.size());
  CUTICLE_TRY(bsdf::evaluate(model, values, bsdf::Precision::f64, {bsdf::Quantity::S, lobe, points}, out));
  for (const glm::dvec3& value : out) y.push_back(value.y);
  return peak_between(x, y);
}

/// The same of the walks: the mean of theta_i within 8 degrees of the fullest bin, near the plane of incidence. The
/// viewer stands where the light is meant to: both ways through an optical path are one path.
double walked_reflection(int order, double theta, std::int64_t walks) {
  constexpr oracle::DirectionBins bins{360, 18};
  const auto orders = oracle::scattering_of(walked(smooth_fibre()), {theta, 0, {}}, bins, order + 1, walks, 37);
  std::vector<double> density(std::size_t(bins.thetas));
  for (int row = 0; row < bins.thetas; ++row)
    for (const int column : {bins.phis / 2 - 1, bins.phis / 2})
      density[std::size_t(row)] += orders[std::size_t(order)].density[std::size_t(row * bins.phis + column)].mean.y;
  const auto top = int(std::ranges::max_element(density) - density.begin());
  double sum = 0, weights = 0;
  for (int row = std::max(top - 16, 0); row <= std::min(top + 16, bins.thetas - 1); ++row) {
    sum += density[std::size_t(row)] * ((row + 0.5) * 180.0 / bins.thetas - 90);
    weights += density[std::size_t(row)];
  }
  return std::abs(sum / weights);
}

/// Models whose lobes have names and whose scales can lean.
constexpr const char* k_models[] = {"chiang", "deon", "huang", "karis", "marschner", "yan_fur"};

Result<void> add_reflections(Feature& feature, int lobe, double theta_i, std::int64_t walks) {
  for (const char* name : k_models) {
    CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(name));
    CUTICLE_ASSIGN(const registry::ParameterValues values,
                   bsdf::parse_settings(*model, "", model->from_fibre(smooth_fibre()).settings));
    CUTICLE_ASSIGN(const double degrees, reflected(*model, values, lobe, theta_i));
    feature.predictions.push_back({name, degrees});
  }
  feature.predictions.push_back({"Monte Carlo", walked_reflection(lobe, theta_i, walks)});
  return {};
}

/// Azimuth of TRT's peak of walks through a fibre whose facets are all but smooth, as seen from `phi_o`.
double walked_glint(double aspect, double phi_o, std::int64_t walks) {
  bsdf::Fibre fibre = smooth_fibre();
  fibre.longitudinal_deviation = 0.01;
  fibre.scale_tilt = 0;
  fibre.aspect = aspect;
  constexpr oracle::DirectionBins bins{1, 360};
  const auto orders = oracle::scattering_of(walked(fibre), {0, phi_o, {}}, bins, 3, walks, 38);
  std::vector<double> x, y;
  for (int column = 180; column < 360; ++column) {
    x.push_back(column + 0.5 - 180);
    y.push_back(orders[2].density[std::size_t(column)].mean.y);
  }
  return peak_between(x, y);
}

Result<double> azimuthal_glint(double aspect, double phi_o) {
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model("marschner"));
  CUTICLE_ASSIGN(const registry::ParameterValues values,
                 bsdf::parse_settings(*model, "", fmt::format("aspect={},sigma_a=0.1/0.1/0.1", aspect)));
  CUTICLE_ASSIGN(const int lobe, bsdf::find_lobe(*model, "TRT"));
  std::vector<bsdf::Point> points;
  std::vector<double> x, y;
  for (double degrees = 0.05; degrees < 180; degrees += 0.1) {
    x.push_back(degrees);
    points.push_back({.phi = degrees * k_degree, .phi_o = phi_o});
  }
  std::vector<glm::dvec3> out(points.size());
  CUTICLE_TRY(bsdf::evaluate(*model, values, bsdf::Precision::f64, {bsdf::Quantity::N, lobe, points}, out));
  for (const glm::dvec3& value : out) y.push_back(value.y);
  return x[std::size_t(std::ranges::max_element(y) - y.begin())];
}

Result<Feature> glint(const std::string& seen, double aspect, double phi_o, std::int64_t walks) {
  Feature feature{fmt::format("azimuth of TRT's glint, aspect {}{}", aspect, seen),
                  "Marschner et al. 2003: theirs moves with the cross-section's turn", "-", 1, 0};
  if (aspect == 1) {
    feature.source = "Marschner et al. 2003: 4 asin(h / eta') - 2 asin(h), h^2 = (4 - eta'^2) / 3";
    feature.published = "18.6";
    feature.low = 17.6;
    feature.high = 19.6;
  }
  CUTICLE_ASSIGN(const double degrees, azimuthal_glint(aspect, phi_o));
  feature.predictions = {{"marschner", degrees}, {"Monte Carlo", walked_glint(aspect, phi_o, walks)}};
  return feature;
}

Feature widths() {
  Feature feature{"width of R in theta_h, human hair", "Marschner et al. 2003, table 1", "5 to 10", 5, 10};
  for (const char* name : {"blond", "brown", "black"})
    feature.predictions.push_back(
        {fmt::format("fibre {}", name), bsdf::find_fibre(name).value().fibre.longitudinal_deviation / 2 / k_degree});
  return feature;
}

std::string verdict(const Feature& feature) {
  if (feature.predictions.empty()) return "no model has it";
  if (feature.low > feature.high) return "";
  std::string outside;
  for (const Feature::Prediction& prediction : feature.predictions)
    if (!(prediction.degrees >= feature.low && prediction.degrees <= feature.high))
      outside += (outside.empty() ? "" : ", ") + prediction.by;
  return outside.empty() ? "all within" : fmt::format("outside {} .. {}: {}", feature.low, feature.high, outside);
}

}  // namespace

Result<std::vector<Feature>> published_features(std::int64_t walks) {
  const std::string shift = "Stamm et al. 1977, Bustard and Smith 1991: mirrored off scales of 2.5 degrees";
  std::vector<Feature> features = {{"R, light at 40 degrees from the root's side", shift, "35", 34.5, 35.5},
                                   {"R, light at 40 degrees from the tip's side", shift, "45", 44.5, 45.5},
                                   {"TRT, light at 40 degrees from the tip's side",
                                    "Wortmann et al. 2003: the back reflection near 31", "31", 30, 32.6}};
  CUTICLE_TRY(add_reflections(features[0], 0, -40 * k_degree, walks));
  CUTICLE_TRY(add_reflections(features[1], 0, 40 * k_degree, walks));
  CUTICLE_TRY(add_reflections(features[2], 2, 40 * k_degree, walks));
  features.push_back(widths());
  CUTICLE_ASSIGN(features.emplace_back(), glint("", 1, 0, walks));
  CUTICLE_ASSIGN(features.emplace_back(), glint(", seen along the major axis", 0.85, 0, walks));
  CUTICLE_ASSIGN(features.emplace_back(), glint(", seen along the minor axis", 0.85, std::numbers::pi / 2, walks));
  features.push_back({"Brewster's angle, by which eta is measured: 57.2 for 1.55",
                      "light is unpolarised in every model and in the walks", "57.2", 1, 0});
  features.push_back({"peak straight ahead, of light that the fibre does not spread", "Khungurn and Marschner 2017",
                      "measured", 1, 0});
  return features;
}

Table feature_table(const std::vector<Feature>& features) {
  Table table{"features",
              "Features of real fibres as published, and what models and walks make of them, in degrees",
              {"feature", "source", "published", "predicted", "verdict"},
              {}};
  for (const Feature& feature : features) {
    std::string predicted;
    for (const Feature::Prediction& prediction : feature.predictions)
      predicted += fmt::format("{}{} {:.1f}", predicted.empty() ? "" : ", ", prediction.by, prediction.degrees);
    table.rows.push_back({feature.what, feature.source, feature.published, predicted, verdict(feature)});
  }
  return table;
}

}  // namespace cuticle::study
