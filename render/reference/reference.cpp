#include "render/reference/reference.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>

#include <fmt/core.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "bsdf/turns.h"

namespace cuticle::render::reference {

namespace {

constexpr int k_tile = 16, k_round = 8;
constexpr double k_dark = 0.05;  // tiles darker than this share of the brightest count as if they were as bright

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

std::vector<std::vector<std::uint32_t>> tiles_of(glm::ivec2 size) {
  std::vector<std::vector<std::uint32_t>> tiles;
  for (int top = 0; top < size.y; top += k_tile)
    for (int left = 0; left < size.x; left += k_tile) {
      tiles.emplace_back();
      for (int y = top; y < std::min(top + k_tile, size.y); ++y)
        for (int x = left; x < std::min(left + k_tile, size.x); ++x)
          tiles.back().push_back(std::uint32_t(y * size.x + x));
    }
  return tiles;
}

/// FNV-1a.
class Hash {
 public:
  template <class T>
  void add(std::span<const T> values) {
    for (const std::byte byte : std::as_bytes(values)) value_ = (value_ ^ std::uint64_t(byte)) * 0x100000001b3u;
  }
  void add(double value) { add(std::span<const double>(&value, 1)); }
  void add(const glm::dvec3& value) { add(std::span<const double>(&value.x, 3)); }
  void add(std::string_view text) { add(std::span<const char>(text)); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

class Rounds {
 public:
  Rounds(const Tracer& tracer, Film& film, const Quality& quality)
      : tracer_(tracer), film_(film), quality_(quality), tiles_(tiles_of(film.size())) {}

  /// The next samples of every tile that does not rest yet; false: all are done.
  bool next() {
    std::vector<std::uint32_t> awake;
    const double floor = darkest_mean();
    for (std::uint32_t t = 0; t < tiles_.size(); ++t)
      if (!rests(tiles_[t], floor)) awake.push_back(t);
    tbb::parallel_for(std::size_t(0), awake.size(), [&](std::size_t k) { trace(tiles_[awake[k]]); });
    return !awake.empty();
  }
  /// Samples drawn, of those that there may be at most.
  std::pair<std::size_t, std::size_t> done() const {
    std::size_t drawn = 0;
    for (const auto& tile : tiles_) drawn += tile.size() * film_.samples(tile.front());
    return {drawn, std::size_t(film_.size().x) * std::size_t(film_.size().y) * std::size_t(quality_.samples)};
  }
  double error() const {
    double mean = 0, square = 0, lit = 0;
    for (const auto& tile : tiles_) {
      const Film::Noise noise = film_.noise(tile);
      if (!(noise.mean > 0)) continue;
      const double count = double(tile.size());
      lit += count;
      mean += noise.mean * count;
      square += noise.standard_error * noise.standard_error * count;
    }
    return mean > 0 ? std::sqrt(square / lit) / (mean / lit) : 0;
  }
  int most_samples() const {
    std::uint32_t most = 0;
    for (const auto& tile : tiles_) most = std::max(most, film_.samples(tile.front()));
    return int(most);
  }

 private:
  double darkest_mean() const {
    double brightest = 0;
    for (const auto& tile : tiles_) brightest = std::max(brightest, film_.noise(tile).mean);
    return k_dark * brightest;
  }
  bool rests(const std::vector<std::uint32_t>& tile, double floor) const {
    const int drawn = int(film_.samples(tile.front()));
    if (drawn >= quality_.samples) return true;
    if (quality_.max_error <= 0 || drawn < 2 * k_round) return false;
    const Film::Noise noise = film_.noise(tile);
    return noise.standard_error <= quality_.max_error * std::max(noise.mean, floor);
  }
  void trace(const std::vector<std::uint32_t>& tile) {
    const std::uint32_t first = film_.samples(tile.front());
    const std::uint32_t last = std::min(first + std::uint32_t(k_round), std::uint32_t(quality_.samples));
    auto& [paths, light, splits] = buffers_.local();
    paths.clear();
    for (const std::uint32_t pixel : tile)
      for (std::uint32_t sample = first; sample < last; ++sample) paths.push_back({pixel, sample});
    light.resize(paths.size());
    splits.resize(film_.has_layers() ? paths.size() : 0);
    tracer_.trace(paths, light, splits);
    for (std::size_t k = 0; k < paths.size(); ++k)
      film_.add(paths[k].pixel, light[k], splits.empty() ? nullptr : &splits[k]);
  }

  const Tracer& tracer_;
  Film& film_;
  const Quality& quality_;
  std::vector<std::vector<std::uint32_t>> tiles_;
  struct Buffers {
    std::vector<PathName> paths;
    std::vector<PathLight> light;
    std::vector<LightSplits> splits;
  };
  tbb::enumerable_thread_specific<Buffers> buffers_;
};

}  // namespace

std::uint64_t key_of(const TracedScene& scene, const TraceOptions& options) {
  Hash hash;
  hash.add(std::span<const std::uint32_t>(scene.hair.offsets));
  hash.add(std::span<const glm::vec3>(scene.hair.positions));
  hash.add(std::span<const float>(scene.hair.radii));
  hash.add(scene.model->entry.name);
  hash.add(registry::to_json(scene.values));
  for (const Light& light : scene.lights) {
    hash.add(light.to_light);
    hash.add(light.irradiance);
    if (!light.point_light) continue;
    for (const glm::dvec3& part : {light.point_light->position, light.point_light->intensity, light.point_light->axis})
      hash.add(part);
    hash.add(light.point_light->inner_angle);
    hash.add(light.point_light->outer_angle);
  }
  for (const Surface& surface : scene.surfaces) {
    hash.add(std::span<const glm::vec3>(surface.mesh.positions));
    hash.add(std::span<const glm::vec3>(surface.albedo));
    hash.add(std::span<const glm::vec3>(surface.at_end.positions));
  }
  if (scene.surroundings) {
    hash.add(std::span<const float>(scene.surroundings->picture.pixels));
    hash.add(scene.surroundings->turn_degrees);
    hash.add(scene.surroundings->scale);
  }
  for (const Camera& camera : {scene.camera, scene.camera_at_end.value_or(scene.camera)}) {
    for (const glm::dvec3& part : {camera.position, camera.target, camera.up}) hash.add(part);
    hash.add(camera.vertical_field_of_view);
  }
  hash.add(std::span<const glm::vec3>(scene.positions_at_end));
  for (const double number :
       {double(options.scatterings), double(options.seed), double(options.far_field), options.lens.radius,
        options.point_light_radius, options.sun_angle, options.clamp_indirect, options.lens.focus_distance})
    hash.add(number);
  if (bsdf::is_turned_by_viewer(scene.values)) {
    hash.add(options.turning.twist);
    hash.add(double(options.turning.seed));
  }
  if (options.tables) {
    hash.add(options.tables->layout);
    hash.add(double(options.tables->size));
  }
  if (options.shadows) {
    hash.add(options.shadows->method);
    hash.add(registry::to_json(options.shadows->values));
    hash.add(options.shadows->alpha);
  }
  if (options.dual_scattering) {
    const DualScatteringInstead& dual = *options.dual_scattering;
    for (const double number : {dual.forward_density, dual.backward_density, dual.direction_spread}) hash.add(number);
  }
  return hash.value();
}

namespace {

/// A picture by a tracer of the scene and options.
Result<Picture> picture_by(const Tracer& tracer, const TracedScene& scene, const TraceOptions& options,
                           const Quality& quality, Progress& progress) {
  if (options.strands && !quality.state.empty())
    return bad_input("outputs: deep and cryptomatte are not kept in a state file", "leave --state out");
  Film film(scene.camera.resolution, options.layers ? split_names(*scene.model) : std::vector<std::string>(),
            options.strands);
  const std::uint64_t key = quality.state.empty() ? 0 : key_of(scene, options);
  if (!quality.state.empty()) CUTICLE_TRY(film.load(quality.state, key));
  Rounds rounds(tracer, film, quality);
  const std::clock_t processor = std::clock();
  const Clock::time_point begin = Clock::now();
  Clock::time_point saved = begin;
  while (rounds.next()) {
    const auto [drawn, all] = rounds.done();
    progress.update("samples", drawn, all);
    if (quality.state.empty() || seconds_since(saved) < quality.save_seconds) continue;
    CUTICLE_TRY(film.save(quality.state, key));
    saved = Clock::now();
  }
  if (!quality.state.empty()) CUTICLE_TRY(film.save(quality.state, key));
  return Picture{film.color(),
                 film.layers(),
                 film.shares(),
                 rounds.most_samples(),
                 rounds.error(),
                 seconds_since(begin),
                 double(std::clock() - processor) / CLOCKS_PER_SEC};
}

}  // namespace

Result<Picture> trace_picture(const TracedScene& scene, const TraceOptions& options, const Quality& quality,
                              Progress& progress) {
  CUTICLE_ASSIGN(const auto tracer, Tracer::make(scene, options));
  return picture_by(*tracer, scene, options, quality, progress);
}

Result<std::vector<Picture>> trace_pictures(const TracedScene& scene, const TraceOptions& options,
                                            const Quality& quality, std::span<const std::uint64_t> seeds,
                                            Progress& progress) {
  CUTICLE_EXPECT(quality.state.empty(), "the state is of one picture");
  CUTICLE_ASSIGN(const auto tracer, Tracer::make(scene, options));
  std::vector<Picture> pictures;
  for (const std::uint64_t seed : seeds) {
    tracer->set_seed(seed);
    CUTICLE_ASSIGN(pictures.emplace_back(), picture_by(*tracer, scene, options, quality, progress));
  }
  return pictures;
}

}  // namespace cuticle::render::reference
