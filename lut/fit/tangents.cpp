#include "lut/fit/detail/tangents.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

namespace cuticle::lut {
namespace {

/// Half a step either way that a parameter's prepared numbers are differenced over.
double step_of(const FreeParameter& free, double value) {
  return 1e-3 * std::max(std::abs(value), 1e-2 * std::min(free.range(), 1.0));
}

/// Derivatives of the prepared numbers by one parameter: f'(x) = (45 d1 - 9 d2 + d3) / 60 h, dk = f(x + k h) - f(x - k
/// h).
std::vector<double> packed_derivative(const JetModel& model, const registry::ParameterValues& values,
                                      const FreeParameter& free) {
  constexpr double weights[] = {45, -9, 1};
  const double value = free.get(values), step = step_of(free, value);
  std::vector<double> sum(CUTICLE_PREPARED_MOST);
  for (int k = 1; k <= 3; ++k) {
    registry::ParameterValues low = values, high = values;
    free.set(low, value - k * step);
    free.set(high, value + k * step);
    const std::vector<double> below = model.pack(low), above = model.pack(high);
    for (std::size_t i = 0; i < below.size(); ++i) sum[i] += weights[k - 1] * (above[i] - below[i]) / (60 * step);
  }
  return sum;
}

/// The prepared numbers with their derivatives by parameters first, first + 1, ...
std::unique_ptr<PackedTangents> pack_tangents(const JetModel& model, const registry::ParameterValues& values,
                                              const std::vector<FreeParameter>& free, std::size_t first) {
  auto packed = std::make_unique<PackedTangents>();
  std::ranges::copy(model.pack(values), packed->value);
  const std::size_t count = std::min(free.size() - first, std::size_t(k_jet_width));
  for (std::size_t j = 0; j < count; ++j) {
    const std::vector<double> derivative = packed_derivative(model, values, free[first + j]);
    for (std::size_t i = 0; i < derivative.size(); ++i) packed->tangents[k_jet_width * i + j] = derivative[i];
  }
  return packed;
}

void store(const RgbTangents& rgb, std::size_t row, std::size_t first, std::size_t count, Tangents& out) {
  for (std::size_t c = 0; c < 3; ++c) {
    out.values[row][int(c)] = rgb.value[c];
    for (std::size_t j = 0; j + first < count && j < std::size_t(k_jet_width); ++j)
      out.gradients[(3 * row + c) * count + first + j] = rgb.gradients[std::size_t(k_jet_width) * c + j];
  }
}

/// Azimuths within a turn, as the models' own loops have them.
std::array<double, 6> coordinates(const bsdf::Point& p) {
  constexpr double turn = 6.283185307179586;
  return {p.theta_i, p.theta_o, p.theta_d, std::remainder(p.phi, turn), p.h, std::remainder(p.phi_o, turn)};
}

std::vector<std::string> names_of_free(const bsdf::Model& model) {
  std::vector<std::string> names;
  for (const registry::Parameter& parameter : model.entry.parameters)
    if (parameter.type == registry::ParameterType::real || parameter.type == registry::ParameterType::rgb)
      names.emplace_back(parameter.name);
  return names;
}

/// Index of the component that ends the name (".r"), taken off; -1 without one.
int take_component(std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || dot + 2 != name.size()) return -1;
  const std::size_t component = std::string_view("rgb").find(name.back());
  if (component == std::string_view::npos) return -1;
  name.resize(dot);
  return int(component);
}

Result<void> add_free(const bsdf::Model& model, std::string name, bool grey, std::vector<FreeParameter>& free) {
  const std::string full = name;
  const int component = take_component(name);
  const auto& table = model.entry.parameters;
  const auto found = std::ranges::find(table, name, &registry::Parameter::name);
  const bool real = found != table.end() && found->type == registry::ParameterType::real && component < 0;
  const bool rgb = found != table.end() && found->type == registry::ParameterType::rgb;
  if (!real && !rgb)
    return usage_error(fmt::format("--free: {} of {} is not one of {}", full, model.entry.name,
                                   fmt::join(names_of_free(model), ", ")));
  const registry::Parameter& parameter = *found;
  if (real || grey || component >= 0) {
    free.push_back({full, &parameter, component});
    return {};
  }
  for (int c = 0; c < 3; ++c) free.push_back({fmt::format("{}.{}", name, "rgb"[c]), &parameter, c});
  return {};
}

/// Values of the rows, lobe by lobe.
std::vector<glm::dvec3> values_of(const bsdf::Model& model, const registry::ParameterValues& values,
                                  const Measurements& measurements) {
  std::vector<glm::dvec3> all(measurements.rows.size());
  for (int lobe = -1; lobe < int(model.lobes.size()); ++lobe) {
    std::vector<bsdf::Point> points;
    for (const Observation& row : measurements.rows)
      if (row.lobe == lobe) points.push_back(row.point);
    std::vector<glm::dvec3> out(points.size());
    const auto evaluated =
        bsdf::evaluate(model, values, bsdf::Precision::f64, {measurements.quantity, lobe, points}, out);
    CUTICLE_EXPECT(evaluated.ok(), "rows are checked before the fit");
    std::size_t next = 0;
    for (std::size_t row = 0; row < all.size(); ++row)
      if (measurements.rows[row].lobe == lobe) all[row] = out[next++];
  }
  return all;
}

}  // namespace

double FreeParameter::get(const registry::ParameterValues& values) const {
  if (parameter->type == registry::ParameterType::real) return values.real(parameter->name);
  return values.rgb(parameter->name)[std::max(component, 0)];
}

void FreeParameter::set(registry::ParameterValues& values, double value) const {
  if (parameter->type == registry::ParameterType::real) return values.set(parameter->name, value);
  glm::dvec3 color = values.rgb(parameter->name);
  if (component < 0)
    color = glm::dvec3(value);
  else
    color[component] = value;
  values.set(parameter->name, color);
}

Result<std::vector<FreeParameter>> free_parameters(const bsdf::Model& model, const std::vector<std::string>& names,
                                                   bool grey) {
  std::vector<FreeParameter> free;
  for (const std::string& name : names) CUTICLE_TRY(add_free(model, name, grey, free));
  for (std::size_t i = 0; i < free.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (free[i].name == free[j].name) return usage_error(fmt::format("--free: {} is given twice", free[i].name));
  return free;
}

Result<const JetModel*> find_jet_model(const bsdf::Model& model) {
  std::vector<std::string_view> names;
  for (const JetModel& jet : jet_models()) {
    if (jet.name == model.entry.name) return &jet;
    names.emplace_back(jet.name);
  }
  return usage_error(fmt::format("{} has no derivatives to fit by; {} have", model.entry.name, fmt::join(names, ", ")));
}

Tangents evaluate_tangents(const JetModel& model, const registry::ParameterValues& values,
                           const std::vector<FreeParameter>& free, const Measurements& measurements) {
  const std::size_t rows = measurements.rows.size();
  Tangents out{std::vector<glm::dvec3>(rows), std::vector<double>(3 * rows * free.size())};
  for (std::size_t first = 0; first < free.size(); first += std::size_t(k_jet_width)) {
    const std::unique_ptr<PackedTangents> packed = pack_tangents(model, values, free, first);
    tbb::parallel_for(std::size_t(0), rows, [&](std::size_t row) {
      const Observation& seen = measurements.rows[row];
      RgbTangents rgb;
      model.evaluate(*packed, int(measurements.quantity), seen.lobe, coordinates(seen.point).data(), rgb);
      store(rgb, row, first, free.size(), out);
    });
  }
  return out;
}

Tangents difference_tangents(const bsdf::Model& model, const registry::ParameterValues& values,
                             const std::vector<FreeParameter>& free, const Measurements& measurements, bool sloped) {
  constexpr double k_share = 1e-3;  // of the parameter's range, either way
  const std::size_t rows = measurements.rows.size();
  Tangents out{values_of(model, values, measurements), std::vector<double>(3 * rows * free.size())};
  for (std::size_t j = 0; sloped && j < free.size(); ++j) {
    const double value = free[j].get(values), step = k_share * std::min(free[j].range(), 1.0);
    const double low = std::max(value - step, free[j].parameter->minimum),
                 high = std::min(value + step, free[j].parameter->maximum);
    registry::ParameterValues moved = values;
    free[j].set(moved, low);
    const std::vector<glm::dvec3> below = values_of(model, moved, measurements);
    free[j].set(moved, high);
    const std::vector<glm::dvec3> above = values_of(model, moved, measurements);
    for (std::size_t row = 0; row < rows; ++row)
      for (int c = 0; c < 3; ++c)
        out.gradients[(3 * row + std::size_t(c)) * free.size() + j] = (above[row][c] - below[row][c]) / (high - low);
  }
  return out;
}

}  // namespace cuticle::lut
