#include "render/reference/wave.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bsdf/turns.h"

namespace cuticle::render::reference {

void VectorArray::resize(std::size_t size) {
  for (std::vector<float>* component : {&x, &y, &z}) component->resize(size);
}

Result<void> WaveScene::build(const TracedScene& traced, const TraceOptions& trace_options) {
  scene = &traced;
  options = trace_options;
  tangents = strands::tangents(traced.hair);
  if (!traced.positions_at_end.empty()) {
    strands::Groom at_end = traced.hair;
    at_end.positions = traced.positions_at_end;
    CUTICLE_TRY(validate(at_end));
    tangents_at_end = strands::tangents(at_end);
  }
  if (bsdf::is_turned_by_viewer(traced.values))
    cross_sections.emplace(traced.hair, traced.positions_at_end, options.turning);
  std::vector<strands::Mesh> meshes, at_end;
  for (const Surface& surface : traced.surfaces) {
    meshes.push_back(surface.mesh);
    at_end.push_back(surface.at_end);
  }
  CUTICLE_ASSIGN(rays, strands::RayScene::build(traced.hair, meshes, traced.positions_at_end, options.curves, at_end));
  if (options.shadows) {
    CUTICLE_ASSIGN(transmittance, VertexTransmittance::make(traced, *options.shadows));
    CUTICLE_ASSIGN(surfaces, strands::RayScene::build({}, meshes, {}, {}, at_end));
  }
  if (options.tables) {
    CUTICLE_ASSIGN(tables, TableScattering::make(*traced.model, traced.values, *options.tables));
  }
  if (options.dual_scattering) {
    CUTICLE_ASSIGN(dual_scattering, DualScattering::make(*traced.model, traced.values, *options.dual_scattering));
    options.scatterings = 1;
  }
  CUTICLE_ASSIGN(model, bsdf::BatchEvaluator::make(*traced.model, traced.values));
  if (traced.surroundings) {
    CUTICLE_ASSIGN(surroundings, SurroundingsLight::make(*traced.surroundings));
  }
  camera.emplace(traced.camera, options.lens);
  if (traced.camera_at_end) camera_at_end.emplace(*traced.camera_at_end, options.lens);
  return {};
}

FibreSegment WaveScene::segment_at(std::uint32_t v, double time) const {
  const std::vector<glm::vec3>& at_begin = scene->hair.positions;
  FibreSegment segment{at_begin[v], at_begin[v + 1], tangents[v], tangents[v + 1]};
  if (tangents_at_end.empty()) return segment;
  const std::vector<glm::vec3>& at_end = scene->positions_at_end;
  segment.begin = glm::mix(segment.begin, glm::dvec3(at_end[v]), time);
  segment.end = glm::mix(segment.end, glm::dvec3(at_end[v + 1]), time);
  segment.tangent_at_begin = glm::mix(segment.tangent_at_begin, glm::dvec3(tangents_at_end[v]), time);
  segment.tangent_at_end = glm::mix(segment.tangent_at_end, glm::dvec3(tangents_at_end[v + 1]), time);
  return segment;
}

FibrePoint WaveScene::point_of(const strands::RayHit& hit, const glm::dvec3& origin, const glm::dvec3& direction,
                               double time) const {
  FibrePoint point = options.curves.is_cone()
                         ? fibre_point(segment_at(hit.vertex, time), hit, origin, direction)
                         : fibre_point(rays->curve_at(hit, time), options.curves.is_flat, hit, origin, direction);
  if (cross_sections) cross_sections->turn(point, time);
  return point;
}

namespace {

glm::dvec3 normal_at(const Surface& surface, std::uint32_t corner, double time) {
  const glm::dvec3 at_begin(surface.mesh.normals[corner]);
  return surface.at_end.normals.empty() ? at_begin
                                        : glm::mix(at_begin, glm::dvec3(surface.at_end.normals[corner]), time);
}

}  // namespace

void Wave::run(std::span<const PathName> names, std::span<PathLight> light, std::span<LightSplits> splits) {
  names_ = names;
  light_ = light;
  splits_ = splits;
  paths_.assign(names.size(), {});
  path_shares_.assign(splits.size(), {});
  std::ranges::fill(splits, LightSplits{});
  live_.clear();
  scattering_ = 0;
  begin_at_camera();
  const int most = scene_.options.scatterings;
  for (; !live_.empty(); ++scattering_) {
    if (most > 0 && scattering_ == most) return end();
    meet();
    for (int round = 0; round < light_rounds(); ++round) {
      light_fibres(round);
      for (const SurfacePoint& point : surface_points_) light_surface(point, round);
    }
    next_.clear();
    if (!scene_.dual_scattering) scatter_fibres();
    for (const SurfacePoint& point : surface_points_) scatter_surface(point);
    std::swap(live_, next_);
  }
}

/// Paths that may not scatter again bring what the surroundings send.
void Wave::end() {
  if (!scene_.surroundings) return;
  for (const std::uint32_t k : live_) {
    const Path& path = paths_[k];
    if (!scene_.rays->is_blocked(path.origin, path.direction, std::numeric_limits<double>::infinity(), path.from,
                                 path.time))
      leave(k);
  }
}

void Wave::begin_at_camera() {
  const auto width = std::uint32_t(scene_.scene->camera.resolution.x);
  for (std::uint32_t k = 0; k < names_.size(); ++k) {
    light_[k] = {};
    const auto place = numbers(k, Purpose::camera);
    glm::dvec2 lens(0);
    if (scene_.options.lens.radius > 0) {
      const auto u = numbers(k, Purpose::lens);
      lens = point_of_disk(double(u[0]), double(u[1]));
    }
    const glm::dvec2 pixel(names_[k].pixel % width + double(place[0]), names_[k].pixel / width + double(place[1]));
    CameraRays::Ray ray = scene_.camera->through(pixel, lens);
    if (scene_.scene->moves()) paths_[k].time = double(numbers(k, Purpose::time)[0]);
    if (scene_.camera_at_end) {
      const CameraRays::Ray last = scene_.camera_at_end->through(pixel, lens);
      ray.origin = glm::mix(ray.origin, last.origin, paths_[k].time);
      ray.direction = glm::normalize(glm::mix(ray.direction, last.direction, paths_[k].time));
    }
    paths_[k].origin = ray.origin;
    paths_[k].direction = ray.direction;
    live_.push_back(k);
  }
}

void Wave::meet() {
  fibre_paths_.clear();
  fibre_points_.clear();
  surface_points_.clear();
  for (const std::uint32_t k : live_) {
    const Path& path = paths_[k];
    const strands::RayHit hit = scene_.rays->closest(path.origin, path.direction, path.from, path.time);
    if (hit.kind == strands::RayHit::Kind::nothing)
      leave(k);
    else if (hit.kind == strands::RayHit::Kind::fibre)
      meet_fibre(k, hit);
    else
      meet_surface(k, hit);
  }
  const std::size_t count = fibre_points_.size();
  for (VectorArray* array : {&to_viewer_, &to_light_, &value_}) array->resize(count);
  for (std::vector<float>* array : {&h_, &density_, &ending_}) array->resize(count);
  for (std::vector<float>& array : u_) array.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    to_viewer_.set(i, fibre_points_[i].local(-paths_[fibre_paths_[i]].direction));
    h_[i] = float(fibre_points_[i].h);
  }
}

/// Out of the scene: what the surroundings send, weighed against having drawn them (the balance heuristic).
void Wave::leave(std::uint32_t k) {
  if (!scene_.surroundings || scattering_ == 0) return;
  const Path& path = paths_[k];
  const double other = scene_.draws_surroundings() ? scene_.surroundings->density(path.direction) : 0;
  const glm::dvec3 radiance = scene_.surroundings->radiance(path.direction);
  add(k, path.throughput * radiance * (path.density / (path.density + other)),
      {scattering_, path.backward, shares_of(k)});
}

void Wave::meet_fibre(std::uint32_t k, const strands::RayHit& hit) {
  const Path& path = paths_[k];
  fibre_points_.push_back(scene_.point_of(hit, path.origin, path.direction, path.time));
  fibre_paths_.push_back(k);
  if (scattering_ > 0) return;
  light_[k].covered = true;
  light_[k].first = {float(scene_.camera->depth(fibre_points_.back().position)), glm::vec3(fibre_points_.back().x),
                     hit.strand + 1};
}

void Wave::meet_surface(std::uint32_t k, const strands::RayHit& hit) {
  const Path& path = paths_[k];
  const Surface& surface = scene_.scene->surfaces[hit.surface];
  const std::array<std::uint32_t, 3>& corners = surface.mesh.triangles[hit.triangle];
  const glm::dvec3 weights(1 - hit.barycentrics.x - hit.barycentrics.y, hit.barycentrics);
  SurfacePoint point{k, path.origin + hit.distance * path.direction, glm::dvec3(0), glm::dvec3(0)};
  for (int c = 0; c < 3; ++c) {
    point.normal += weights[c] * normal_at(surface, corners[std::size_t(c)], path.time);
    point.albedo += weights[c] * glm::dvec3(surface.albedo[corners[std::size_t(c)]]);
  }
  const double length = glm::length(point.normal);
  point.normal = length > 0 ? point.normal / length : -path.direction;
  if (glm::dot(point.normal, path.direction) > 0) point.normal = -point.normal;
  surface_points_.push_back(point);
  if (scattering_ > 0) return;
  light_[k].covered = true;
  light_[k].first.depth = float(scene_.camera->depth(point.position));
}

/// Russian roulette: a path goes on with the probability of its brightest channel.
bool Wave::goes_on(std::uint32_t k, const glm::dvec3& throughput, double u) {
  const double most = std::max({throughput.x, throughput.y, throughput.z});
  if (!(most > 0) || !std::isfinite(most)) return false;
  const double chance = std::min(1.0, most);
  if (!(u < chance)) return false;
  paths_[k].throughput = throughput / chance;
  next_.push_back(k);
  return true;
}

void Wave::add(std::uint32_t k, const glm::dvec3& arrived, const Way& way) {
  PathLight& to = light_[k];
  const double limit = scene_.options.clamp_indirect, brightest = std::max({arrived.x, arrived.y, arrived.z});
  const bool is_clamped = limit > 0 && way.scatterings > 1 && brightest > limit;
  const glm::dvec3 light = is_clamped ? arrived * (limit / brightest) : arrived;
  to.radiance += light;
  if (!splits()) return;
  constexpr int k_least[k_counts] = {1, 2, 3, 4, 8, 16};
  int count = 0;
  while (count + 1 < k_counts && way.scatterings >= k_least[count + 1]) ++count;
  LightSplits& split = splits_[k];
  split[std::size_t(count)] += light;
  const int turn = way.scatterings == 1 ? 0 : std::min(1 + way.backward, k_turns - 1);
  split[std::size_t(k_counts + turn)] += light;
  for (std::size_t lobe = 0; way.shares && lobe < k_max_lobes; ++lobe)
    split[k_counts + k_turns + lobe] += light * (*way.shares)[lobe];
}

}  // namespace cuticle::render::reference
