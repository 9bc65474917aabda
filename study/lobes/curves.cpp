// Curves of a model's terms over angles, and the places on them that the literature names.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "bsdf/marschner/marschner.h"
#include "study/lobes/lobes_study.h"

namespace cuticle::study {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Which coordinate varies, over how many degrees to each side, at fixed other coordinates.
struct Sweep {
  bsdf::Quantity quantity;
  double bsdf::Point::*varied;
  double reach_deg;
  bsdf::Point at;
};

Result<Curve> sweep_curve(const bsdf::Model& model, const registry::ParameterValues& values, const Sweep& sweep,
                          int lobe, std::size_t samples) {
  Curve curve{lobe < 0 ? "sum" : std::string(model.lobes[std::size_t(lobe)]), {}, {}};
  std::vector<bsdf::Point> points(samples, sweep.at);
  for (std::size_t i = 0; i < samples; ++i) {
    curve.x.push_back(sweep.reach_deg * (2 * double(i) / double(samples - 1) - 1));
    points[i].*sweep.varied = curve.x.back() * degree;
  }
  std::vector<glm::dvec3> out(samples);
  CUTICLE_TRY(bsdf::evaluate(model, values, bsdf::Precision::f64, {sweep.quantity, lobe, points}, out));
  for (const glm::dvec3& value : out) curve.y.push_back(value.y);
  return curve;
}

/// One curve a lobe, without the lobes that are nothing here.
Result<void> add_curves(Plot& plot, const bsdf::Model& model, const registry::ParameterValues& values,
                        const Sweep& sweep, std::size_t samples) {
  for (int lobe = 0; lobe < int(model.lobes.size()); ++lobe) {
    CUTICLE_ASSIGN(Curve curve, sweep_curve(model, values, sweep, lobe, samples));
    if (std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return y != 0; }))
      plot.curves.push_back(std::move(curve));
  }
  return {};
}

double peak_of(const Curve& curve) {
  return curve.x[std::size_t(std::max_element(curve.y.begin(), curve.y.end()) - curve.y.begin())];
}

/// Where M of a lobe peaks at theta_o = 0, in steps of a hundredth of a degree.
Result<double> longitudinal_peak(const bsdf::Model& model, const registry::ParameterValues& values, int lobe) {
  const Sweep sweep{bsdf::Quantity::M, &bsdf::Point::theta_i, 60, {}};
  CUTICLE_ASSIGN(const Curve curve, sweep_curve(model, values, sweep, lobe, 12001));
  return peak_of(curve);
}

/// Marschner et al. 2003: phi of the caustic of TRT for eta' = 1.55.
constexpr double caustic_deg = 18.62;

/// A line at x as high as what the plot has.
Curve upright(std::string name, double x, const Plot& plot) {
  double height = 0;
  for (const Curve& curve : plot.curves) height = std::max(height, *std::max_element(curve.y.begin(), curve.y.end()));
  return {std::move(name), {x, x}, {0, height}};
}

Result<Landmarks> longitudinal_landmarks(const bsdf::Model& model, const std::string& settings, std::size_t samples) {
  // A wide lobe's M peaks further out than its shift (0.8 degrees for TRT at a width of 0.4), so the fibre is made
  // smooth.
  CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(model, "", settings + ",beta=0.02"));
  const double shift = -2 * registry::from_values<bsdf::marschner::Parameters>(values).alpha / degree;
  Landmarks found;
  Plot plot{"landmarks_M", "marschner: M of narrow lobes at theta_o = 0", "theta_i, degrees", "M, 1/rad", false, {}};
  const Sweep sweep{bsdf::Quantity::M, &bsdf::Point::theta_i, 15, {}};
  CUTICLE_TRY(add_curves(plot, model, values, sweep, samples));
  const struct {
    const char* lobe;
    double factor;
  } shifts[] = {{"R", -1}, {"TT", 0.5}, {"TRT", 1.5}};
  for (const auto& expected : shifts) {
    CUTICLE_ASSIGN(const int lobe, bsdf::find_lobe(model, expected.lobe));
    CUTICLE_ASSIGN(const double peak, longitudinal_peak(model, values, lobe));
    found.places.push_back({std::string(model.entry.name),
                            fmt::format("peak of M_{} in theta_i at theta_o = 0", expected.lobe),
                            expected.factor * shift, peak});
    plot.curves.push_back(upright(fmt::format("{} expected", expected.lobe), expected.factor * shift, plot));
  }
  found.plots.push_back(std::move(plot));
  return found;
}

Result<Landmarks> azimuthal_landmarks(const bsdf::Model& model, std::size_t samples) {
  Plot plot{"landmarks_N",  "marschner: N of a round fibre of index 1.55 at theta_d = 0",
            "phi, degrees", "N, 1/rad",
            false,          {}};
  CUTICLE_ASSIGN(const registry::ParameterValues glass, bsdf::parse_settings(model, "", "eta=1.55"));
  CUTICLE_TRY(add_curves(plot, model, glass, {bsdf::Quantity::N, &bsdf::Point::phi, 60, {}}, samples));
  CUTICLE_ASSIGN(const int trt, bsdf::find_lobe(model, "TRT"));
  CUTICLE_ASSIGN(const Curve fine,
                 sweep_curve(model, glass, {bsdf::Quantity::N, &bsdf::Point::phi, 60, {}}, trt, 12001));
  for (const double side : {-1.0, 1.0}) plot.curves.push_back(upright("caustic expected", side * caustic_deg, plot));
  return Landmarks{
      {{std::string(model.entry.name), "caustic of N_TRT at eta' = 1.55", caustic_deg, std::abs(peak_of(fine))}},
      {std::move(plot)}};
}

}  // namespace

Result<std::vector<Plot>> lobe_plots(const bsdf::Model& model, const std::string& settings, std::size_t samples) {
  CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(model, "", settings));
  const std::string name(model.entry.name);
  // Models with colours in place of absorption have factors whose peak is 1 as M.
  const bool has_colors = model.conventions.absorption.starts_with("none");
  std::vector<Plot> plots = {
      {name + "_M",
       name + ": M at theta_o = 20 degrees",
       "theta_i, degrees",
       has_colors ? "M, factor" : "M, 1/rad",
       false,
       {}},
      {name + "_N",
       name + ": N at theta_d = 0 (green)",
       "phi, degrees",
       has_colors ? "N, 1/sr" : "N, 1/rad",
       false,
       {}},
      {name + "_S", name + ": S at theta_i = theta_o = 0 (green), logarithmic", "phi, degrees", "S, 1/sr", true, {}}};
  const Sweep sweeps[] = {{bsdf::Quantity::M, &bsdf::Point::theta_i, 90, {.theta_o = 20 * degree}},
                          {bsdf::Quantity::N, &bsdf::Point::phi, 180, {}},
                          {bsdf::Quantity::S, &bsdf::Point::phi, 180, {}}};
  for (std::size_t i = 0; i < plots.size(); ++i) CUTICLE_TRY(add_curves(plots[i], model, values, sweeps[i], samples));
  return plots;
}

Result<Grid> lobe_grid(const bsdf::Model& model, const std::string& settings, std::size_t samples) {
  CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(model, "", settings));
  const std::string name(model.entry.name);
  Grid grid{name + "_S_grid", name + ": S at theta_o = 20 degrees (green)", "phi, degrees", "theta_i, degrees",
            "S, 1/sr"};
  const std::size_t rows = samples / 2 + 1;
  std::vector<bsdf::Point> points;
  for (std::size_t i = 0; i < samples; ++i) grid.x.push_back(360 * double(i) / double(samples - 1) - 180);
  for (std::size_t k = 0; k < rows; ++k) {
    grid.y.push_back(178 * double(k) / double(rows - 1) - 89);
    for (const double phi : grid.x)
      points.push_back({.theta_i = grid.y.back() * degree, .theta_o = 20 * degree, .phi = phi * degree});
  }
  std::vector<glm::dvec3> out(points.size());
  CUTICLE_TRY(bsdf::evaluate(model, values, bsdf::Precision::f64, {bsdf::Quantity::S, -1, points}, out));
  for (std::size_t k = 0; k < rows; ++k) {
    grid.values.emplace_back();
    for (std::size_t i = 0; i < samples; ++i) grid.values.back().push_back(out[k * samples + i].y);
  }
  return grid;
}

Result<Curve> albedo_curve(const bsdf::Model& model, const std::string& settings, std::size_t samples) {
  CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(model, "", settings));
  const Sweep sweep{bsdf::Quantity::albedo, &bsdf::Point::theta_o, 89.9, {}};
  CUTICLE_ASSIGN(Curve curve, sweep_curve(model, values, sweep, -1, samples));
  curve.name = model.entry.name;
  return curve;
}

Result<Landmarks> landmarks_of(const bsdf::Model& model, const std::string& settings, std::size_t samples) {
  CUTICLE_ASSIGN(Landmarks found, longitudinal_landmarks(model, settings, samples));
  CUTICLE_ASSIGN(const Landmarks azimuthal, azimuthal_landmarks(model, samples));
  found.places.insert(found.places.end(), azimuthal.places.begin(), azimuthal.places.end());
  found.plots.insert(found.plots.end(), azimuthal.plots.begin(), azimuthal.plots.end());
  return found;
}

}  // namespace cuticle::study
