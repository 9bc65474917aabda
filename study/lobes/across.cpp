// All models beside light that is walked through one rough fibre, facet by facet.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/core.h>

#include "study/lobes/lobes_study.h"
#include "study/oracle/rough_fibre.h"

namespace cuticle::study {
namespace {

using std::numbers::pi;

constexpr std::array k_viewers = {-0.7, 0.0, 0.35, 0.9};  ///< theta_o
constexpr oracle::DirectionBins k_bins{12, 18};
constexpr std::size_t k_bin_count = std::size_t(k_bins.thetas) * std::size_t(k_bins.phis);
constexpr int k_along = 2, k_around = 6;  ///< points of a bin, in theta_i and in phi
constexpr int k_orders = 20;              ///< crossings that are followed
constexpr double k_slowest_rounds = 4e7;  ///< loop rounds of a tier, all points together

double inclination(int row, int rows) { return ((row + 0.5) / rows - 0.5) * pi; }

/// Green S of each viewer and bin, mean over the bin's solid angle, and what another seed would change it by.
struct Walks {
  std::vector<double> density, standard_error;
};
Walks walk_all(const bsdf::Fibre& fibre, std::int64_t walks) {
  Walks all;
  for (const double theta_o : k_viewers) {
    const auto orders = oracle::scattering_of(walked(fibre), {theta_o, 0, {}}, k_bins, k_orders, walks, 24);
    for (std::size_t bin = 0; bin < k_bin_count; ++bin) {
      double mean = 0, variance = 0;
      for (const oracle::OrderScattering& order : orders) {
        mean += order.density[bin].mean.y;
        variance += order.density[bin].standard_error.y * order.density[bin].standard_error.y;
      }
      all.density.push_back(mean);
      all.standard_error.push_back(std::sqrt(variance));
    }
  }
  return all;
}

/// Points of all viewers and bins, those of a bin together.
std::vector<bsdf::Point> points_in_bins() {
  std::vector<bsdf::Point> points;
  for (const double theta_o : k_viewers)
    for (std::size_t bin = 0; bin < k_bin_count; ++bin)
      for (int i = 0; i < k_along; ++i)
        for (int k = 0; k < k_around; ++k)
          points.push_back({.theta_i = inclination(int(bin) / k_bins.phis * k_along + i, k_bins.thetas * k_along),
                            .theta_o = theta_o,
                            .phi = ((int(bin) % k_bins.phis * k_around + k + 0.5) / (k_bins.phis * k_around) - 0.5) * 2 * pi});
  return points;
}

/// Means over the solid angle of each bin.
std::vector<double> means_of(const std::vector<bsdf::Point>& points, const std::vector<glm::dvec3>& values) {
  constexpr std::size_t each = k_along * k_around;
  std::vector<double> means(points.size() / each);
  for (std::size_t bin = 0; bin < means.size(); ++bin) {
    double sum = 0, weights = 0;
    for (std::size_t n = bin * each; n < (bin + 1) * each; ++n) {
      sum += values[n].y * std::cos(points[n].theta_i);
      weights += std::cos(points[n].theta_i);
    }
    means[bin] = sum / weights;
  }
  return means;
}

double solid_angle(std::size_t bin) {
  const double height = pi / k_bins.thetas;
  const double middle = inclination(int(bin % k_bin_count) / k_bins.phis, k_bins.thetas);
  return 2 * std::sin(height / 2) * std::cos(middle) * 2 * pi / k_bins.phis;
}

/// Root of the mean square over the sphere.
double rms(const std::vector<double>& density) {
  double sum = 0, weights = 0;
  for (std::size_t bin = 0; bin < density.size(); ++bin) {
    sum += solid_angle(bin) * density[bin] * density[bin];
    weights += solid_angle(bin);
  }
  return std::sqrt(sum / weights);
}

/// (S - truth) over the rms of the truth, by the root of the bin's share of the sphere: their root mean square is the error.
std::vector<double> density_errors(const std::vector<double>& means, const std::vector<double>& truth) {
  const double mean_angle = 4 * pi / double(k_bin_count), scale = rms(truth);
  std::vector<double> errors(means.size());
  for (std::size_t bin = 0; bin < errors.size(); ++bin)
    errors[bin] = (means[bin] - truth[bin]) / scale * std::sqrt(solid_angle(bin) / mean_angle);
  return errors;
}

/// Albedo less the truth's, of each viewer.
std::vector<double> albedo_errors(const std::vector<double>& means, const std::vector<double>& truth) {
  std::vector<double> errors(k_viewers.size());
  for (std::size_t bin = 0; bin < means.size(); ++bin) errors[bin / k_bin_count] += solid_angle(bin) * (means[bin] - truth[bin]);
  return errors;
}

struct AcrossCase {
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;
  std::shared_ptr<const std::vector<bsdf::Point>> points;
  std::shared_ptr<const Walks> truth;
};

Result<Measured> distance_to_walks(const AcrossCase& at) {
  std::vector<glm::dvec3> out(at.points->size());
  CUTICLE_TRY(bsdf::evaluate(*at.model, at.values, bsdf::Precision::f32, {bsdf::Quantity::S, -1, *at.points}, out));
  const std::vector<double> means = means_of(*at.points, out);
  return Measured{{density_errors(means, at.truth->density), albedo_errors(means, at.truth->density)}};
}

Work few_points(const AcrossCase& at) {
  constexpr std::size_t count = 16;
  const auto out = std::make_shared<std::vector<glm::dvec3>>(count);
  return {{},
          [at, out]() -> Result<void> {
            at.model->evaluate_f32(at.values, {bsdf::Quantity::S, -1, std::span(*at.points).subspan(at.points->size() / 2, count)}, *out);
            return {};
          },
          double(count)};
}

bool is_too_slow(const AcrossCase& at) {
  return at.model->loop_rounds &&
         double(at.model->loop_rounds(at.values, bsdf::Quantity::S)) * double(at.points->size()) > k_slowest_rounds;
}

Group empty_group(const LobesRequest& request, const Walks& truth) {
  return {.name = "all models",
          .title = "All models beside light walked through one rough fibre",
          .truth = fmt::format("{} walks from facet to facet for each of {} inclinations, Gaussian slopes whose R lobe has the fibre's "
                               "longitudinal deviation; means of S over {} x {} bins of the sphere",
                               request.walks, k_viewers.size(), k_bins.thetas, k_bins.phis),
          .metrics = {{"S", "rms error of S over its rms", "1", Mean::root_mean_square}, {"albedo", "error of albedo"}},
          .item = "bin",
          .floor = rms(truth.standard_error) / rms(truth.density)};
}

}  // namespace

oracle::RoughFibre walked(const bsdf::Fibre& fibre) {
  return {.eta = fibre.eta,
          .sigma_a = fibre.sigma_a,
          .surface = {oracle::Facets::beckmann, std::clamp(fibre.longitudinal_deviation / std::sqrt(2.0), 1e-3, 1.0)},
          .tilt = fibre.scale_tilt,
          .aspect = fibre.aspect,
          .blocked = oracle::Blocked::followed,
          .medulla = {fibre.medulla_ratio, fibre.medulla_scattering, glm::dvec3(fibre.medulla_absorption), fibre.medulla_anisotropy}};
}

Result<Group> across_models(std::span<const bsdf::Model* const> models, const LobesRequest& request) {
  const auto truth = std::make_shared<const Walks>(walk_all(request.fibre, request.walks));
  const auto points = std::make_shared<const std::vector<bsdf::Point>>(points_in_bins());
  Group group = empty_group(request, *truth);
  for (const bsdf::Model* model : models)
    for (const LobesTier& tier : tiers_of(*model, settings_of(*model, request.fibre).settings)) {
      CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(*model, "", tier.settings));
      const AcrossCase at{model, values, points, truth};
      if ((model->near_field && model->near_field(values)) || is_too_slow(at)) continue;
      group.points.push_back({std::string(model->entry.name), {{"tier", tier.name}}, [at] { return distance_to_walks(at); }, few_points(at)});
    }
  return group;
}

}  // namespace cuticle::study
