#include "tests/hard_cases/search/coordinates.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <fmt/core.h>

namespace cuticle::hard_cases::search {
namespace {

/// Where a parameter's range would cost seconds a case, the search ends earlier.
struct Limit {
  std::string_view name;
  double most;
};
constexpr Limit k_limits[] = {{"resolution", 96}, {"iterations", 16},   {"samples", 128},
                              {"turns", 16},      {"max_substeps", 64}, {"rays", 128}};

double most_of(const registry::Parameter& parameter) {
  const auto limit = std::ranges::find(k_limits, parameter.name, &Limit::name);
  return limit == std::end(k_limits) ? parameter.maximum : std::min(parameter.maximum, limit->most);
}

/// In the middle the default; towards 0 and 1 the ends of the range, by factors where it spans many.
double number_at(const registry::Parameter& parameter, double at) {
  const double most = most_of(parameter);
  const double usual =
      std::clamp(std::strtod(std::string(parameter.default_text).c_str(), nullptr), parameter.minimum, most);
  const double end = at < 0.5 ? parameter.minimum : most, share = std::abs(2 * at - 1);
  if (usual > 0 && end > 0 && std::abs(std::log(end / usual)) > 3)
    return std::clamp(usual * std::pow(end / usual, share), parameter.minimum, most);
  return std::clamp(usual + (end - usual) * share, parameter.minimum, most);
}

std::string value_at(const registry::Parameter& parameter, double at) {
  switch (parameter.type) {
    case registry::ParameterType::choice: {
      const std::size_t count = parameter.choices.size();
      return std::string(parameter.choices[std::min(count - 1, std::size_t(at * double(count)))]);
    }
    case registry::ParameterType::boolean:
      return at < 0.5 ? "false" : "true";
    case registry::ParameterType::integer:
      return fmt::format("{:.0f}", std::round(number_at(parameter, at)));
    case registry::ParameterType::real:
    case registry::ParameterType::rgb:
      break;
  }
  return fmt::format("{}", number_at(parameter, at));
}

}  // namespace

double Coordinates::by_factors(double least, double most) { return least * std::pow(most / least, next()); }

double Coordinates::around_zero(double most) {
  const double signed_share = 2 * next() - 1, share = std::pow(std::abs(signed_share), 8);
  return share < 1e-12 ? 0 : std::copysign(most * share, signed_share);
}

std::size_t Coordinates::below(std::size_t count) { return std::min(count - 1, std::size_t(next() * double(count))); }

Json Coordinates::point(double most) {
  Json list = Json::list();
  for (std::size_t k = 0; k < k_point; ++k) list.push_back(between(-most, most));
  return list;
}

Json Coordinates::direction() {
  const double inclination = between(-0.5, 0.5) * std::numbers::pi, azimuth = between(-1, 1) * std::numbers::pi;
  return Json::list(
      {std::sin(inclination), std::cos(inclination) * std::cos(azimuth), std::cos(inclination) * std::sin(azimuth)});
}

Json Coordinates::groom(std::size_t strands, std::size_t vertices, double most) {
  Json all = Json::list();
  for (std::size_t s = 0; s < strands; ++s) {
    Json strand = Json::list();
    for (std::size_t v = 0; v < vertices; ++v) strand.push_back(point(most));
    all.push_back(std::move(strand));
  }
  return Json{{"radius", by_factors(1e-6, 1e-2)}, {"points", std::move(all)}};
}

std::string Coordinates::settings(registry::ParameterTable table, std::span<const std::string_view> kept) {
  std::string text;
  for (const registry::Parameter& parameter : table) {
    const double at = next();
    if (std::ranges::find(kept, parameter.name) != kept.end()) continue;
    if (at != 0.5 || most_of(parameter) != parameter.maximum)
      text += fmt::format("{}{}={}", text.empty() ? "" : ",", parameter.name, value_at(parameter, at));
  }
  return text;
}

}  // namespace cuticle::hard_cases::search
