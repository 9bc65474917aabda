#include "viz/lobes/curves.h"

#include <algorithm>
#include <functional>
#include <numbers>

#include <fmt/format.h>

#include "lut/cell_average.h"
#include "viz/lobes/numbers.h"

namespace cuticle::viz {
namespace {

Result<std::vector<double>> values_of(const ShownModel& shown, bsdf::Quantity quantity, int lobe,
                                      std::span<const bsdf::Point> points) {
  std::vector<glm::dvec3> colors(points.size());
  CUTICLE_TRY(bsdf::evaluate(*shown.model, shown.values, bsdf::Precision::f64, {quantity, lobe, points}, colors));
  std::vector<double> values;
  std::transform(colors.begin(), colors.end(), std::back_inserter(values), mean);
  return values;
}

LobeCurve curve_of(std::string name, const std::vector<double>& degrees, const std::vector<double>& values) {
  LobeCurve curve{std::move(name), {}};
  for (std::size_t i = 0; i < degrees.size(); ++i) curve.points.emplace_back(degrees[i], values[i]);
  return curve;
}

std::vector<double> steps(double lower, double upper, int count) {
  std::vector<double> places;
  for (int k = 0; k < count; ++k) places.push_back(lower + (upper - lower) * k / (count - 1));
  return places;
}

/// Means over half a degree, through the caustic.
Result<std::vector<double>> averaged_n(const ShownModel& shown, int lobe, double theta_d,
                                       const std::vector<double>& degrees) {
  const lut::Channel channel{"N", bsdf::Quantity::N, shown.model->lobes[std::size_t(lobe)], 0,
                             lut::Texel::cell_average};
  std::vector<lut::PhiInterval> cells;
  for (const double phi : degrees) {
    const double middle = std::clamp(std::abs(phi), 0.25, 179.75);
    cells.push_back({theta_d, (middle - 0.25) * k_degree, (middle + 0.25) * k_degree});
  }
  CUTICLE_ASSIGN(const lut::PhiAverages averages,
                 lut::average_over_phi(lut::cpu_source(*shown.model, shown.values), channel, cells));
  std::vector<double> values;
  std::transform(averages.values.begin(), averages.values.end(), std::back_inserter(values), mean);
  return values;
}

}  // namespace

bool is_near_field(const ShownModel& shown) { return shown.model->near_field && shown.model->near_field(shown.values); }

Result<std::vector<LobeCurve>> longitudinal_curves(const ShownModel& shown, const LobeSettings& settings) {
  const std::vector<double> degrees = steps(-90, 90, 361);
  std::vector<bsdf::Point> points;
  for (const double theta : degrees)
    points.push_back({.theta_i = settings.theta_i, .theta_o = theta * k_degree, .h = settings.h});
  std::vector<LobeCurve> curves;
  for (int lobe = 0; lobe < int(shown.model->lobes.size()); ++lobe) {
    CUTICLE_ASSIGN(const auto values, values_of(shown, bsdf::Quantity::M, lobe, points));
    curves.push_back(curve_of(std::string(shown.model->lobes[std::size_t(lobe)]), degrees, values));
  }
  return curves;
}

Result<std::vector<LobeCurve>> azimuthal_curves(const ShownModel& shown, const LobeSettings& settings) {
  const std::vector<double> degrees = steps(-180, 180, 721);
  std::vector<bsdf::Point> points;
  for (const double phi : degrees)
    points.push_back({.theta_d = -settings.theta_i, .phi = phi * k_degree, .h = settings.h});
  std::vector<LobeCurve> curves;
  for (int lobe = 0; lobe < int(shown.model->lobes.size()); ++lobe) {
    CUTICLE_ASSIGN(const auto values, shown.model->azimuthal_means ? averaged_n(shown, lobe, -settings.theta_i, degrees)
                                                                   : values_of(shown, bsdf::Quantity::N, lobe, points));
    curves.push_back(curve_of(std::string(shown.model->lobes[std::size_t(lobe)]), degrees, values));
  }
  return curves;
}

Result<std::vector<LobeCurve>> azimuthal_slices(const ShownModel& shown, const LobeSettings& settings) {
  const std::vector<double> degrees = steps(-180, 180, 721);
  std::vector<LobeCurve> curves;
  for (const double h : {-0.9, -0.6, -0.3, 0.0, 0.5}) {
    std::vector<bsdf::Point> points;
    for (const double phi : degrees) points.push_back({.theta_d = -settings.theta_i, .phi = phi * k_degree, .h = h});
    CUTICLE_ASSIGN(const auto values, values_of(shown, bsdf::Quantity::N, -1, points));
    curves.push_back(curve_of(fmt::format("h = {:g}", h), degrees, values));
  }
  return curves;
}

double cone_of(const LobeCurve& longitudinal) {
  const auto peak = std::max_element(longitudinal.points.begin(), longitudinal.points.end(),
                                     [](const auto& a, const auto& b) { return a.y < b.y; });
  return peak->x * k_degree;
}

}  // namespace cuticle::viz
