// Curves of a model's terms over angles, and the places on them that the literature names.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include <cuticle/study/lobes/lobes_study.h>

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

}  // namespace

Result<std::vector<Plot>> lobe_plots(const bsdf::Model& model, const std::string& settings, std::size_t samples) {
  CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(model, "", settings));
  const std::string name(model.entry.name);
  std::vector<Plot> plots = {
      {name + "_M", name + ": M at theta_o = 20 degrees", "theta_i, degrees", "M, 1/rad", false, {}},
      {name + "_N", name + ": N at theta_d = 0 (green)", "phi, degrees", "N, 1/rad", false, {}},
      {name + "_S", name + ": S at theta_i = theta_o = 0 (green), logarithmic", "phi, degrees", "S, 1/sr", true, {}}};
  const Sweep sweeps[] = {{bsdf::Quantity::M, &bsdf::Point::theta_i, 90, {.theta_o = 20 * degree}},
                          {bsdf::Quantity::N, &bsdf::Point::phi, 180, {}},
                          {bsdf::Quantity::S, &bsdf::Point::phi, 180, {}}};
  for (std::size_t i = 0; i < plots.size(); ++i) CUTICLE_TRY(add_curves(plots[i], model, values, sweeps[i], samples));
  return plots;
}

Result<Curve> albedo_curve(const bsdf::Model& model, const std::string& settings, std::size_t samples) {
  CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(model, "", settings));
  const Sweep sweep{bsdf::Quantity::albedo, &bsdf::Point::theta_o, 89.9, {}};
  CUTICLE_ASSIGN(Curve curve, sweep_curve(model, values, sweep, -1, samples));
  curve.name = model.entry.name;
  return curve;
}

Result<std::vector<Landmark>> landmarks_of(const bsdf::Model& model, const std::string& settings) {
  std::vector<Landmark> landmarks;
  // A wide lobe's M peaks further out than its shift (0.8 degrees for TRT at a width of 0.4), so the fibre is made
  // smooth.
  CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(model, "", settings + ",beta=0.02"));
  const double shift = -2 * values.real("alpha") / degree;
  const struct {
    const char* lobe;
    double factor;
  } shifts[] = {{"R", -1}, {"TT", 0.5}, {"TRT", 1.5}};
  for (const auto& expected : shifts) {
    CUTICLE_ASSIGN(const int lobe, bsdf::find_lobe(model, expected.lobe));
    CUTICLE_ASSIGN(const double peak, longitudinal_peak(model, values, lobe));
    landmarks.push_back({std::string(model.entry.name),
                         fmt::format("peak of M_{} in theta_i at theta_o = 0", expected.lobe), expected.factor * shift,
                         peak});
  }
  const Sweep sweep{bsdf::Quantity::N, &bsdf::Point::phi, 60, {}};
  CUTICLE_ASSIGN(const registry::ParameterValues glass, bsdf::parse_settings(model, "", "eta=1.55"));
  CUTICLE_ASSIGN(const int trt, bsdf::find_lobe(model, "TRT"));
  CUTICLE_ASSIGN(const Curve curve, sweep_curve(model, glass, sweep, trt, 12001));
  landmarks.push_back(
      {std::string(model.entry.name), "caustic of N_TRT at eta' = 1.55", 18.62, std::abs(peak_of(curve))});
  return landmarks;
}

}  // namespace cuticle::study
