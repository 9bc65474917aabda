#include "study/model_check/registered.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include <fmt/core.h>

#include "core/random.h"
#include "core/registry/find_value.h"

namespace cuticle::study::model_check {
namespace {

using registry::Parameter;
using registry::ParameterType;
using registry::ParameterValues;

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

bool is_roughness(const Parameter& p) {
  return p.type == ParameterType::real && (p.name.starts_with("beta") || contains(p.name, "roughness"));
}
bool is_tilt(const Parameter& p) {
  const bool named = p.name.starts_with("alpha") || contains(p.name, "tilt") || contains(p.name, "shift");
  return p.type == ParameterType::real && p.unit == "rad" && named;
}
bool is_azimuthal(const Parameter& p) { return p.name == "beta_n"; }
bool is_tolerance(const Parameter& p) { return p.type == ParameterType::real && contains(p.name, "tolerance"); }
bool is_path_count(const Parameter& p) { return p.type == ParameterType::integer && p.name == "samples"; }
bool is_absorption(const Parameter& p) { return p.name == "sigma_a" || p.name == "sigma_ma"; }

/// Of the azimuth, the narrowest is wider: averages over the fibre cost as much more as their lobes are narrow, and
/// energy is not changed by it.
double roughness_of(const Parameter& p, Roughness roughness) {
  constexpr std::array<double, 5> widths = {0, 0, 0.1, 0.25, 0.6};
  const double least = is_azimuthal(p) ? 0.05 : 0;
  return std::clamp(std::max(widths[std::size_t(roughness)], least), p.minimum, p.maximum);
}

double in_range(const Parameter& p, double value) { return std::clamp(value, p.minimum, p.maximum); }

void set_absorption(ParameterValues& values, const Parameter& p, Absorption absorption) {
  const glm::dvec3 colour = absorption == Absorption::none ? glm::dvec3(0) : glm::dvec3(0.1, 0.5, 2);
  if (p.type == ParameterType::rgb)
    values.set(p.name, glm::dvec3(in_range(p, colour.x), in_range(p, colour.y), in_range(p, colour.z)));
  if (p.type == ParameterType::real) values.set(p.name, in_range(p, colour.y));
}

double tilt_of(const Parameter& p, Tilt tilt) {
  return tilt == Tilt::none ? 0.0 : p.minimum < 0 ? std::max(p.minimum, -0.0873) : std::min(p.maximum, 0.0873);
}

/// A quadrature's default tolerance or number of paths, brought to what the checks' bounds need; one that was chosen
/// stays.
void set_effort(ParameterValues& values, const Parameter& p, Effort effort) {
  constexpr double needed = 1e-4;
  constexpr std::int64_t enough_paths = 256;
  if (is_tolerance(p) && values.real(p.name) == registry::default_values({&p, 1}).real(p.name))
    values.set(p.name, in_range(p, std::max(values.real(p.name), needed)));
  if (!is_path_count(p)) return;
  if (effort == Effort::draft) values.set(p.name, std::int64_t(p.minimum));
  if (effort == Effort::given && values.integer(p.name) == registry::default_values({&p, 1}).integer(p.name))
    values.set(p.name, std::min<std::int64_t>(values.integer(p.name), enough_paths));
}

/// The values put into a situation; parameters that it does not speak of keep theirs.
ParameterValues in_situation(const bsdf::Model& model, ParameterValues values, const Situation& situation) {
  for (const Parameter& p : model.entry.parameters) {
    if (situation.roughness != Roughness::given && is_roughness(p))
      values.set(p.name, roughness_of(p, situation.roughness));
    if (situation.absorption != Absorption::given && is_absorption(p)) set_absorption(values, p, situation.absorption);
    if (situation.tilt != Tilt::given && is_tilt(p)) values.set(p.name, tilt_of(p, situation.tilt));
    set_effort(values, p, situation.effort);
  }
  return values;
}

std::string label_of(const Situation& situation) {
  constexpr std::array<std::string_view, 3> absorption = {"absorption as given", "no absorption", "coloured"};
  constexpr std::array<std::string_view, 5> roughness = {"roughness as given", "narrowest", "narrow", "usual roughness",
                                                         "wide"};
  constexpr std::array<std::string_view, 3> tilt = {"tilt as given", "no tilt", "strong tilt"};
  return fmt::format("{}, {}, {}", absorption[std::size_t(situation.absorption)],
                     roughness[std::size_t(situation.roughness)], tilt[std::size_t(situation.tilt)]);
}

bool is_path(std::string_view lobe) { return lobe == "R" || lobe == "TT" || lobe == "TRT" || lobe == "TRRT"; }

bool is_rest(std::string_view lobe) { return lobe == "residual" || lobe.ends_with("+"); }

bool carries_all_orders(const bsdf::Model& model) {
  return std::any_of(model.lobes.begin(), model.lobes.end(), is_rest);
}

/// Of the cross-section; 1 where the model has no ellipse.
double aspect_of(const ParameterValues& values) {
  return registry::find_value<double>(values, "aspect").value_or(1);
}

/// The dielectric cylinder that the values describe, where the model follows the paths of one and nothing else.
std::optional<Cylinder> cylinder_of(const bsdf::Model& model, const ParameterValues& values) {
  const auto eta = registry::find_value<double>(values, "eta");
  const auto sigma_a = registry::find_value<glm::dvec3>(values, "sigma_a");
  const bool paths_only = std::all_of(model.lobes.begin(), model.lobes.end(),
                                      [](std::string_view lobe) { return is_path(lobe) || is_rest(lobe); });
  if (!eta || !sigma_a || !paths_only || aspect_of(values) != 1) return {};
  return Cylinder{*eta, *sigma_a, carries_all_orders(model) ? 0 : int(model.lobes.size())};
}

Batch batch_of(const bsdf::Model& model, const ParameterValues& values, bsdf::Precision precision,
               bsdf::Quantity quantity) {
  return [&model, values, precision, quantity](std::span<const bsdf::Point> points, std::span<glm::dvec3> out) {
    if (const auto done = bsdf::evaluate(model, values, precision, {quantity, -1, points}, out); !done)
      std::fill(out.begin(), out.end(), glm::dvec3(std::nan("")));
  };
}

Scatterer scatterer_of(const bsdf::Model& model, const ParameterValues& values, bsdf::Precision precision) {
  using bsdf::Quantity;
  const auto batch = [&](Quantity quantity) { return batch_of(model, values, precision, quantity); };
  Scatterer scatterer;
  scatterer.scattering = batch(Quantity::S);
  scatterer.albedo = batch(Quantity::albedo);
  scatterer.others = {{"M", batch(Quantity::M)},
                      {"N", batch(Quantity::N)},
                      {"A", batch(Quantity::A)},
                      {"error", batch(Quantity::error)}};
  scatterer.error = batch(Quantity::error);
  scatterer.cylinder = cylinder_of(model, values);
  scatterer.aspect = aspect_of(values);
  if (!model.sample_f64) return scatterer;
  scatterer.pdf = batch(Quantity::pdf);
  scatterer.sample = [&model, values, precision](std::span<const bsdf::SampleQuery> queries,
                                                 std::span<bsdf::Sample> out) {
    if (const auto done = bsdf::sample(model, values, precision, queries, out); !done)
      std::fill(out.begin(), out.end(), bsdf::Sample{.theta_i = std::nan("")});
  };
  return scatterer;
}

/// A number of a range: an end of it, or anything between, by ratio where the range spans decades.
double pick(RandomStream& random, double low, double high) {
  const double kind = random.next_unit(), place = random.next_unit();
  if (kind < 0.2) return low;
  if (kind < 0.4) return high;
  if (low > 0 && high > 100 * low) return low * std::pow(high / low, place);
  return kind < 0.7 ? low + (high - low) * place : low + (high - low) * place * place * place;
}

registry::Value pick_value(RandomStream& random, const Parameter& p) {
  switch (p.type) {
    case ParameterType::integer:
      if (is_path_count(p)) return std::int64_t(p.minimum);
      return std::int64_t(std::floor(pick(random, p.minimum, p.maximum) + 0.5));
    case ParameterType::boolean:
      return random.next_unit() < 0.5;
    case ParameterType::choice:
      return std::string(p.choices[std::size_t(random.next_unit() * double(p.choices.size()))]);
    case ParameterType::rgb:
      return glm::dvec3(pick(random, p.minimum, p.maximum), pick(random, p.minimum, p.maximum),
                        pick(random, p.minimum, p.maximum));
    case ParameterType::real:
      break;
  }
  return pick(random, p.minimum, p.maximum);
}

Scatterer varied(const bsdf::Model& model, bsdf::Precision precision, std::uint64_t number) {
  RandomStream random(number, 17);
  ParameterValues values = registry::default_values(model.entry.parameters);
  std::string label;
  for (const Parameter& p : model.entry.parameters) {
    const registry::Value value = pick_value(random, p);
    label += fmt::format("{}{}={}", label.empty() ? "" : ",", p.name, registry::to_text(value));
    values.set(p.name, value);
  }
  Scatterer scatterer = scatterer_of(model, values, precision);
  scatterer.label = label;
  return scatterer;
}

/// Whether "name=value" or "name!=value" is so; nothing always is.
bool holds(std::string_view when, const ParameterValues& values) {
  const std::size_t equal = when.find('=');
  if (equal == std::string_view::npos) return true;
  const bool differs = when[equal - 1] == '!';
  const auto value = values.all().find(when.substr(0, equal - (differs ? 1 : 0)));
  return (value != values.all().end() && registry::to_text(value->second) == when.substr(equal + 1)) != differs;
}

}  // namespace

std::vector<std::string> variants_of(const bsdf::Model& model) {
  std::vector<std::string> variants = {""};
  for (const Parameter& p : model.entry.parameters) {
    for (std::string_view choice : p.choices)
      if (choice != p.default_text) variants.push_back(fmt::format("{}={}", p.name, choice));
    if (p.name == "aspect") variants.push_back("aspect=0.85");
  }
  return variants;
}

std::vector<bsdf::Exception> exceptions_of(const bsdf::Model& model, const ParameterValues& values) {
  std::vector<bsdf::Exception> found;
  std::copy_if(model.exceptions.begin(), model.exceptions.end(), std::back_inserter(found),
               [&](const bsdf::Exception& exception) { return holds(exception.when, values); });
  return found;
}

Subject subject_of(const bsdf::Model& model, const registry::ParameterValues& values, bsdf::Precision precision) {
  Subject subject;
  subject.name = model.entry.name;
  subject.near_field = model.near_field && model.near_field(values);
  subject.complete = carries_all_orders(model);
  subject.lobes = std::max<std::size_t>(model.lobes.size(), 1);
  subject.rounding = precision == bsdf::Precision::f32 ? 1e-6 : 1e-12;
  subject.make = [&model, values, precision](const Situation& situation) -> std::optional<Scatterer> {
    Scatterer scatterer = scatterer_of(model, in_situation(model, values, situation), precision);
    scatterer.label = label_of(situation);
    return scatterer;
  };
  subject.vary = [&model, precision](std::uint64_t number) { return varied(model, precision, number); };
  return subject;
}

}  // namespace cuticle::study::model_check
