#include "study/conformance/conformance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bsdf/fibre/fibres.h"

namespace cuticle::study {
namespace {

constexpr double k_degree = std::numbers::pi / 180;
constexpr int k_easy = 24;  ///< points inside the domain for each quantity, lobe and fibre

struct Place {
  bsdf::Point point;
  bool hard = false;
};

/// Van der Corput's sequence in base b: evenly spread, the same on every machine.
double spread(int index, int base) {
  double value = 0, share = 1.0 / base;
  for (int rest = index; rest > 0; rest /= base, share /= base) value += rest % base * share;
  return value;
}

/// In whole hundredths, so that what the table prints is what was evaluated.
bsdf::Point point_at(double theta_i_deg, double theta_o_deg, double phi_deg, double h) {
  const auto rounded = [](double x) { return std::round(x * 100) / 100; };
  return {.theta_i = rounded(theta_i_deg) * k_degree,
          .theta_o = rounded(theta_o_deg) * k_degree,
          .phi = rounded(phi_deg) * k_degree,
          .h = rounded(h)};
}

std::vector<Place> places() {
  std::vector<Place> all;
  for (int i = 1; i <= k_easy; ++i)
    all.push_back({point_at(140 * spread(i, 2) - 70, 140 * spread(i, 3) - 70, 360 * spread(i, 5) - 180,
                            1.9 * spread(i, 7) - 0.95)});
  for (const double theta_i : {-89.0, 0.0, 89.0})
    for (const double theta_o : {-89.0, 0.0, 30.0}) all.push_back({point_at(theta_i, theta_o, 37, 0.3), true});
  for (const double phi : {-180.0, 0.0, 180.0}) all.push_back({point_at(20, -15, phi, 0), true});
  for (const double h : {-1.0, 0.99, 1.0}) all.push_back({point_at(20, -15, 60, h), true});
  return all;
}

/// What the model makes of a narrow, a blond, a black and a rough fibre; its defaults where it knows no fibres.
std::vector<std::string> settings_of(const bsdf::Model& model) {
  bsdf::Fibre blond = bsdf::find_fibre("blond").value().fibre, narrow = blond, rough = blond;
  const bsdf::Fibre black = bsdf::find_fibre("black").value().fibre;
  narrow.longitudinal_deviation = narrow.azimuthal_deviation = 0.05;
  rough.longitudinal_deviation = rough.azimuthal_deviation = 0.4;
  rough.scale_tilt = 0;
  std::vector<std::string> all;
  for (const bsdf::Fibre& fibre : {narrow, blond, black, rough})
    all.push_back(model.from_fibre ? model.from_fibre(fibre).settings : "");
  if (!model.from_fibre) all.resize(1);
  return all;
}

Result<std::vector<registry::ParameterValues>> fibres_of(const bsdf::Model& model) {
  std::vector<registry::ParameterValues> all;
  for (const std::string& settings : settings_of(model)) {
    const std::string comma = settings.empty() ? "" : ",";
    std::vector<std::string> fields = {""};
    if (model.near_field) fields = {comma + "field=far", comma + "field=near"};
    for (const std::string& field : fields) {
      CUTICLE_ASSIGN(all.emplace_back(), bsdf::parse_settings(model, "", settings + field));
    }
  }
  return all;
}

/// Every parameter, so that an implementation needs none of our defaults.
std::string all_settings(const registry::ParameterValues& values) {
  std::string text;
  for (const auto& [name, value] : values.all())
    text += fmt::format("{}{}={}", text.empty() ? "" : ",", name, registry::to_text(value));
  return text;
}

double largest_of(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// One column of values in double, with what single precision makes of them and the model's bound.
Result<void> add_column(const bsdf::Model& model, const registry::ParameterValues& values, bsdf::Quantity quantity,
                        int lobe, std::vector<ConformanceRow>& rows) {
  const std::vector<Place> all = places();
  std::vector<bsdf::Point> points;
  for (const Place& place : all) points.push_back(place.point);
  std::vector<glm::dvec3> exact(points.size()), single(points.size()), bound(points.size());
  CUTICLE_TRY(bsdf::evaluate(model, values, bsdf::Precision::f64, {quantity, lobe, points}, exact));
  CUTICLE_TRY(bsdf::evaluate(model, values, bsdf::Precision::f32, {quantity, lobe, points}, single));
  if (quantity == bsdf::Quantity::S)
    CUTICLE_TRY(bsdf::evaluate(model, values, bsdf::Precision::f64, {bsdf::Quantity::error, lobe, points}, bound));
  double largest = 0;
  for (const glm::dvec3& value : exact) largest = std::max(largest, largest_of(value));
  const std::string settings = all_settings(values);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double tolerance = std::max(
        {1e-4 * largest_of(exact[i]), 1e-6 * largest, 16 * largest_of(single[i] - exact[i]), 3 * largest_of(bound[i])});
    rows.push_back({settings, quantity, lobe, points[i], exact[i], tolerance, all[i].hard});
  }
  return {};
}

std::string_view name_of(bsdf::Quantity quantity) {
  return quantity == bsdf::Quantity::S ? "S" : quantity == bsdf::Quantity::pdf ? "pdf" : "albedo";
}

}  // namespace

Result<std::vector<ConformanceRow>> conformance_rows(const bsdf::Model& model) {
  CUTICLE_ASSIGN(const std::vector<registry::ParameterValues> fibres, fibres_of(model));
  std::vector<ConformanceRow> rows;
  for (const registry::ParameterValues& values : fibres) {
    for (int lobe = -1; lobe < int(model.lobes.size()); ++lobe)
      CUTICLE_TRY(add_column(model, values, bsdf::Quantity::S, lobe, rows));
    if (model.sample_f64) CUTICLE_TRY(add_column(model, values, bsdf::Quantity::pdf, -1, rows));
    CUTICLE_TRY(add_column(model, values, bsdf::Quantity::albedo, -1, rows));
  }
  return rows;
}

std::string conformance_csv(const bsdf::Model& model, const std::vector<ConformanceRow>& rows) {
  std::string text = "model,settings,quantity,lobe,theta_i_deg,theta_o_deg,phi_deg,h,r,g,b,tolerance,hard\n";
  for (const ConformanceRow& row : rows) {
    const auto degrees = [](double angle) { return std::round(angle / k_degree * 100) / 100; };
    text += fmt::format("{},\"{}\",{},{},{},{},{},{},{},{},{},{:.3g},{}\n", model.entry.name, row.settings,
                        name_of(row.quantity), row.lobe < 0 ? "sum" : model.lobes[std::size_t(row.lobe)],
                        degrees(row.point.theta_i), degrees(row.point.theta_o), degrees(row.point.phi), row.point.h,
                        row.value.x, row.value.y, row.value.z, row.tolerance, row.hard ? 1 : 0);
  }
  return text;
}

}  // namespace cuticle::study
