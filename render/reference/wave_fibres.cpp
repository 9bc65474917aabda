// What happens at fibres: lights that reach them, and where paths go from them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "render/reference/wave.h"

namespace cuticle::render::reference {

namespace {

/// What cannot fail: arrays of one size, points in range, a model that draws.
void must([[maybe_unused]] const Result<void>& done) { CUTICLE_EXPECT(done.ok(), "a model's call"); }

/// Light of less than this share of what an even scatterer sends to all sides is asked for by chance.
constexpr double k_worth_a_ray = 1;

}  // namespace

/// Russian roulette for rays to lights, after the scattering that the camera sees: `scattered` is S times the path's
/// throughput; `light` is divided by the chance with which the ray is traced.
bool Wave::is_worth_a_ray(std::uint32_t path, int round, const glm::dvec3& scattered, glm::dvec3& light) const {
  if (scattering_ == 0) return true;
  const double most = std::max({scattered.x, scattered.y, scattered.z});
  const double chance = std::min(1.0, 4 * std::numbers::pi * most / k_worth_a_ray);
  if (!(double(numbers(path, Purpose::shadow)[std::size_t(round)]) < chance)) return false;
  light /= chance;
  return true;
}

void WaveScene::evaluate(const bsdf::BatchPoints& points, const bsdf::OutputSpans& color) const {
  if (tables)
    tables->evaluate(points, color);
  else
    must(model->evaluate(points, color));
}

/// What of a light arrives past hair and surfaces, 0 .. 1.
glm::dvec3 Wave::reaching(std::size_t i, const Arriving& light) const {
  const FibrePoint& point = fibre_points_[i];
  const bool by_method = scene_.transmittance && light.light;
  const strands::RayScene& blockers = by_method ? *scene_.surfaces : *scene_.rays;
  if (blockers.is_blocked(point.position, light.to_light, light.distance, point.from, paths_[fibre_paths_[i]].time))
    return glm::dvec3(0);
  return by_method ? scene_.transmittance->at(*light.light, point) : glm::dvec3(1);
}

/// Whether light from there comes back on the viewer's side of the fibre.
bool Wave::turns_back(std::size_t i, const glm::vec3& to_light) const {
  return to_light.y * to_viewer_.y[i] + to_light.z * to_viewer_.z[i] > 0;
}

/// L = sum of S E over the lights, without a cosine; of a direction drawn from the surroundings S L / density, weighed
/// against the model's own samples.
void Wave::light_fibres(int round) {
  std::vector<Arriving> lights(fibre_points_.size());
  bool compared = false;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    lights[i] = arriving(fibre_points_[i].position, fibre_paths_[i], round);
    to_light_.set(i, fibre_points_[i].local(lights[i].to_light));
    compared = compared || lights[i].density > 0;
  }
  const bsdf::BatchPoints points{to_light_.in(), to_viewer_.in(), h_};
  scene_.evaluate(points, value_.out());
  if (compared && !scene_.dual_scattering) must(scene_.model->pdf(points, density_));
  std::vector<Shares> shares;
  if (splits() && scattering_ == 0) find_shares(to_light_, shares);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const std::uint32_t k = fibre_paths_[i];
    const Shares* const of_lobes = shares.empty() ? shares_of(k) : &shares[i];
    if (scene_.dual_scattering) {
      light_by_dual_scattering(i, lights[i], of_lobes);
      continue;
    }
    const Path& path = paths_[k];
    glm::dvec3 light = path.throughput * glm::dvec3(value_[i]) * lights[i].irradiance;
    if (lights[i].density > 0) light *= lights[i].density / (lights[i].density + double(density_[i]));
    if (!(std::max({light.x, light.y, light.z}) > 0)) continue;
    if (!is_worth_a_ray(k, round, path.throughput * glm::dvec3(value_[i]), light)) continue;
    light *= reaching(i, lights[i]);
    if (!(std::max({light.x, light.y, light.z}) > 0)) continue;
    const int backward = path.backward + int(scattering_ > 0 && turns_back(i, to_light_[i]));
    add(k, light, {scattering_ + 1, backward, of_lobes});
  }
}

/// The share of each lobe in S toward these directions.
void Wave::find_shares(const VectorArray& to_light, std::vector<Shares>& shares) const {
  const std::size_t count = fibre_points_.size();
  std::vector<bsdf::Point> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 light(to_light[i]), viewer(to_viewer_[i]);
    const double phi_o = std::atan2(viewer.z, viewer.y);
    points[i] = {.theta_i = std::asin(std::clamp(light.x, -1.0, 1.0)),
                 .theta_o = std::asin(std::clamp(viewer.x, -1.0, 1.0)),
                 .phi = phi_o - std::atan2(light.z, light.y),
                 .h = fibre_points_[i].h,
                 .phi_o = phi_o};
  }
  const TracedScene& traced = *scene_.scene;
  std::vector<glm::dvec3> sum(count, glm::dvec3(0)), value(count);
  shares.assign(count, Shares{});
  const std::size_t lobes = std::min(traced.model->lobes.size(), std::size_t(k_max_lobes));
  for (std::size_t lobe = 0; lobe < lobes; ++lobe) {
    const bsdf::Request request{bsdf::Quantity::S, int(lobe), points};
    must(bsdf::evaluate(*traced.model, traced.values, bsdf::Precision::f32, request, value));
    for (std::size_t i = 0; i < count; ++i) {
      shares[i][lobe] = value[i];
      sum[i] += value[i];
    }
  }
  for (std::size_t i = 0; i < count; ++i)
    for (glm::dvec3& share : shares[i])
      for (int c = 0; c < 3; ++c) share[c] = sum[i][c] > 0 ? share[c] / sum[i][c] : 0;
}

void Wave::draw_directions() {
  for (std::size_t i = 0; i < fibre_paths_.size(); ++i) {
    const auto direction = numbers(fibre_paths_[i], Purpose::direction);
    const auto ending = numbers(fibre_paths_[i], Purpose::ending);
    for (std::size_t n = 0; n < direction.size(); ++n) u_[n][i] = direction[n];
    ending_[i] = ending[0];
    for (std::size_t n = 1; n < ending.size(); ++n) u_[3 + n][i] = ending[n];
  }
  const bsdf::BatchQueries queries{to_viewer_.in(), h_, {u_[0], u_[1], u_[2], u_[3], u_[4], u_[5], u_[6]}};
  must(scene_.model->sample(queries, to_light_.out()));
}

void Wave::scatter_fibres() {
  if (fibre_paths_.empty()) return;
  draw_directions();
  const bsdf::BatchPoints points{to_light_.in(), to_viewer_.in(), h_};
  scene_.evaluate(points, value_.out());
  must(scene_.model->pdf(points, density_));
  if (splits() && scattering_ == 0) find_shares(to_light_, shares_);
  for (std::size_t i = 0; i < fibre_paths_.size(); ++i) {
    const std::uint32_t k = fibre_paths_[i];
    Path& path = paths_[k];
    const double density = double(density_[i]);
    if (!(density > 0)) continue;
    if (!goes_on(k, path.throughput * glm::dvec3(value_[i]) / density, double(ending_[i]))) continue;
    path.origin = fibre_points_[i].position;
    path.direction = fibre_points_[i].world(to_light_[i]);
    path.from = fibre_points_[i].from;
    path.density = density;
    path.backward += int(scattering_ > 0 && turns_back(i, to_light_[i]));
    if (splits() && scattering_ == 0) path_shares_[k] = shares_[i];
  }
}

}  // namespace cuticle::render::reference
