#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/random.h"
#include "study/model_check/checks/checks.h"

namespace cuticle::study::model_check {
namespace {

// Any azimuth from the major axis will do; only elliptical fibres use it.
constexpr double azimuth_of_the_viewer = 0.7;

std::vector<bsdf::Point> views(const Subject& subject, std::span<const double> degrees,
                               std::span<const double> offsets) {
  std::vector<bsdf::Point> all;
  for (double theta : degrees)
    for (double h : subject.near_field ? offsets : offsets.first(1))
      all.push_back({.theta_o = theta * degree, .h = h, .phi_o = azimuth_of_the_viewer});
  return all;
}

}  // namespace

std::vector<bsdf::Point> furnace_views(const Subject& subject, const Options& options) {
  constexpr double degrees[] = {0, 89.9, -60, 35, -35, 80, 89, -89.9};
  constexpr double offsets[] = {0.3, -0.95};
  const std::span<const double> all(degrees);
  return views(subject, options.quick ? all.first(3) : all, offsets);
}

std::vector<bsdf::Point> sampling_views(const Subject& subject, const Options& options) {
  constexpr double degrees[] = {40, -80, 0};
  constexpr double offsets[] = {0.3, -0.8};
  const std::span<const double> all(degrees), both(offsets);
  return views(subject, options.quick ? all.first(2) : all, options.quick ? both.first(1) : both);
}

std::string where(const Subject& subject, const Scatterer& scatterer, const bsdf::Point& view) {
  const std::string offset = subject.near_field ? fmt::format(", h = {:.4g}", view.h) : "";
  return fmt::format("theta_o = {:.6g} deg{} ({})", view.theta_o / degree, offset, scatterer.label);
}

std::vector<Scatterer> scatterers(const Subject& subject, std::span<const Situation> situations) {
  std::vector<Scatterer> all;
  for (const Situation& situation : situations)
    if (std::optional<Scatterer> made = subject.make(situation)) all.push_back(std::move(*made));
  return all;
}

Verdict skipped(std::string why) { return {.check = {}, .words = std::move(why)}; }

Verdict judged(double measured, double allowed, std::string words) {
  return {.check = {},
          .state = measured <= allowed ? State::passed : State::failed,
          .measured = measured,
          .allowed = allowed,
          .words = std::move(words)};
}

double brightness(const glm::dvec3& rgb) { return (rgb.x + rgb.y + rgb.z) / 3; }

double largest(const glm::dvec3& rgb) { return std::max({std::abs(rgb.x), std::abs(rgb.y), std::abs(rgb.z)}); }

std::vector<glm::dvec3> values_at(const Batch& batch, std::span<const bsdf::Point> points) {
  std::vector<glm::dvec3> values(points.size());
  batch(points, values);
  return values;
}

glm::dvec3 value_at(const Batch& batch, const bsdf::Point& point) { return values_at(batch, {&point, 1})[0]; }

std::vector<bsdf::Sample> draw(const Scatterer& scatterer, const bsdf::Point& view, std::size_t count,
                               std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<bsdf::SampleQuery> queries(count, {.theta_o = view.theta_o, .phi_o = view.phi_o, .h = view.h});
  for (bsdf::SampleQuery& query : queries)
    for (double& u : query.u) u = random.next_unit();
  std::vector<bsdf::Sample> samples(count);
  scatterer.sample(queries, samples);
  return samples;
}

bsdf::Point point_of(const bsdf::Sample& sample, const bsdf::Point& view) {
  bsdf::Point point = view;
  point.theta_i = sample.theta_i;
  point.phi = sample.phi;
  return point;
}

bool averages(const Scatterer& scatterer, const bsdf::Point& view) {
  if (!scatterer.error) return false;
  // Where narrow lobes give nothing they report no error, so that a few of their own samples are asked too.
  std::vector<bsdf::Point> places = {view};
  if (scatterer.sample)
    for (const bsdf::Sample& sample : draw(scatterer, view, 8, 1)) places.push_back(point_of(sample, view));
  const std::vector<glm::dvec3> errors = values_at(scatterer.error, places);
  return std::any_of(errors.begin(), errors.end(), [](const glm::dvec3& error) { return largest(error) > 0; });
}

void Worst::note(double candidate, const std::string& place) {
  if (!where.empty() && !(candidate > value)) return;
  value = candidate;
  where = place;
}

}  // namespace cuticle::study::model_check
