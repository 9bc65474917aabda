// Ray-traced truth: the mean over a disc of prod(1 - alpha) over the distinct fibres that rays to the light enter.
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task.h>
#include <glm/geometric.hpp>

#include "core/registry/members.h"
#include "shadows/footprint.h"
#include "shadows/light_frame.h"
#include "shadows/method.h"
#include "shadows/own_fibre.h"
#include "strands/rays/rays.h"
#include "strands/rays/round_cone.h"
// After the headers that include glm/matrix.hpp: the dialect defines Vec2 and Vec3.
#include "core/shared/philox.glslh"

namespace cuticle::shadows::truth {
namespace {

struct Parameters {
  std::int64_t rays = 1024;
  double footprint_radius = 0;
};
void describe(registry::Members& members, Parameters& parameters) {
  members(parameters.rays, "rays", 1, 65536, "rays per point, rounded up to a square: one in each cell of a grid");
  members.millimetres(
      parameters.footprint_radius, "footprint_radius_mm", 0, 1000,
      "radius of the disc around the point that rays start from; 0: two strand spacings (four across), and none around "
      "points where a viewer's rays met the hair");
}
constexpr std::string_view k_demands[] = {"light", "shadow_method"};

/// Mean and its standard error at one point.
struct Estimate {
  float mean = 1, standard_error = 0;
  float occluder = std::numeric_limits<float>::infinity();  // metres to the nearest
};

class Tracer {
 public:
  Tracer(const strands::RayGroom& rays, const Casters& casters, double radius, std::int64_t count)
      : rays_(rays), casters_(casters), radius_(radius), side_(std::uint32_t(std::ceil(std::sqrt(double(count))))) {}

  struct Scratch {
    std::vector<strands::Crossing> crossings;
    OwnStretch stretch;
    double occluder = 0;
  };
  Estimate at(const Receivers& receivers, std::size_t i, Scratch& scratch) const {
    const glm::dvec3 direction = way_from(glm::dvec3(receivers.points[i])).direction;
    const PlaneAxes axes = plane_axes(direction);
    const auto own = own_vertex(*casters_.groom, receivers, i);
    const glm::dvec3 point = seen_point(receivers, i, own);
    scratch.stretch = own ? stretch_of(*own, point, direction) : OwnStretch{};
    scratch.occluder = std::numeric_limits<double>::infinity();
    double sum = 0, squares = 0;
    for (std::uint32_t ray = 0; ray < side_ * side_; ++ray) {
      const double t = transmittance(receivers, i, point + start_of(ray, std::uint32_t(i), axes), scratch);
      sum += t;
      squares += t * t;
    }
    const double count = double(side_) * side_, mean = sum / count;
    const double variance = std::max(0.0, squares / count - mean * mean);
    return {float(mean), count > 1 ? float(std::sqrt(variance / (count - 1))) : 0.0f, float(scratch.occluder)};
  }

 private:
  /// From a point to the light: a unit direction, and how far.
  struct Way {
    glm::dvec3 direction;
    double distance;
  };
  Way way_from(const glm::dvec3& point) const {
    if (!casters_.point_light)
      return {casters_.to_light / glm::length(casters_.to_light), std::numeric_limits<double>::infinity()};
    const glm::dvec3 to_point_light = *casters_.point_light - point;
    const double distance = glm::length(to_point_light);
    return {distance > 0 ? to_point_light / distance : glm::dvec3(0, 1, 0), distance};
  }

  /// Where a ray starts, relative to the point: a random place in the ray's cell of the disc, by rings and sectors of
  /// equal area.
  glm::dvec3 start_of(std::uint32_t ray, std::uint32_t receiver, const PlaneAxes& axes) const {
    const PhiloxBlock words = philox(PhiloxBlock{ray, receiver, 0, 0}, 0x5eedu, 0);
    double u = 0, v = 0;
    unit_interval(words.a, u);
    unit_interval(words.b, v);
    const double r = radius_ * std::sqrt((ray / side_ + u) / side_);
    const double angle = 2 * std::numbers::pi * ((ray % side_ + v) / side_);
    return r * (std::cos(angle) * axes.first + std::sin(angle) * axes.second);
  }

  /// The receiver on the surface that its viewer sees.
  glm::dvec3 seen_point(const Receivers& receivers, std::size_t i, const std::optional<OwnVertex>& own) const {
    const glm::dvec3 point(receivers.points[i]);
    if (!receivers.met.empty()) return glm::dvec3(receivers.met[i]);
    if (!own || !receivers.seen_from) return point;
    const strands::Groom& groom = *casters_.groom;
    return point + to_seen_surface(point, glm::dvec3(own_along(groom, *own)), *receivers.seen_from,
                                   double(groom.radii[own->vertex]));
  }

  double transmittance(const Receivers& receivers, std::size_t i, const glm::dvec3& from, Scratch& scratch) const {
    const Way way = way_from(from);
    rays_.all_crossings(from, way.direction, scratch.crossings);
    int count = 0;
    for (const strands::Crossing& crossing : scratch.crossings) {
      const double middle = 0.5 * (double(crossing.entry) + double(crossing.exit));
      const bool own = !receivers.strands.empty() && crossing.strand == receivers.strands[i] &&
                       is_own(scratch.stretch, from, way.direction, crossing);
      const bool holds_start = crossing.entry <= 0;
      if (middle >= way.distance || own || holds_start) continue;
      scratch.occluder = std::min(scratch.occluder, double(crossing.entry));
      ++count;
    }
    return std::pow(1 - casters_.alpha, count);
  }

  /// The part of its strand that does not shadow a receiver: as far as a ray from its disc may be inside.
  OwnStretch stretch_of(const OwnVertex& own, const glm::dvec3& point, const glm::dvec3& direction) const {
    const strands::Groom& groom = *casters_.groom;
    const double radius = double(groom.radii[own.vertex]);
    return own_stretch(own, radius_ + 2 * radius, 2 * radius, [&](std::uint32_t v) {
      const glm::dvec3 away = glm::dvec3(groom.positions[v]) - point;
      return glm::length(away - glm::dot(away, direction) * direction);
    });
  }

  /// A crossing of the point's own strand that begins, or goes on, in that part.
  bool is_own(const OwnStretch& stretch, const glm::dvec3& from, const glm::dvec3& direction,
              const strands::Crossing& crossing) const {
    for (std::uint32_t v = stretch.begin; v < stretch.end; ++v) {
      const strands::LineInterval inside = strands::round_cone_interval(from, direction, sphere(v), sphere(v + 1));
      if (inside.first <= double(crossing.exit) && inside.last >= double(crossing.entry)) return true;
    }
    return false;
  }
  glm::vec4 sphere(std::uint32_t v) const { return {casters_.groom->positions[v], casters_.groom->radii[v]}; }

  const strands::RayGroom& rays_;
  const Casters& casters_;
  double radius_;
  std::uint32_t side_;
};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void trace_all(const Tracer& tracer, const Receivers& receivers, Transmittance& result) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, receivers.points.size()), [&](const auto& range) {
    Tracer::Scratch scratch;
    for (std::size_t i = range.begin(); i < range.end() && !tbb::is_current_task_group_canceling(); ++i) {
      const Estimate estimate = tracer.at(receivers, i, scratch);
      result.values[i] = estimate.mean;
      result.standard_error[i] = estimate.standard_error;
      result.occluders[i] = estimate.occluder;
    }
  });
}

/// From points where a viewer's rays met the hair all rays are one, unless a disc is asked for.
Tracer tracer_of(const Parameters& parameters, const strands::RayGroom& rays, const Casters& casters,
                 const Receivers& receivers) {
  if (parameters.footprint_radius > 0) return {rays, casters, parameters.footprint_radius, parameters.rays};
  if (!receivers.met.empty()) return {rays, casters, 0, 1};
  return {rays, casters, default_footprint_radius(*casters.groom), parameters.rays};
}

Result<Transmittance> evaluate(const Casters& casters, const Receivers& receivers,
                               const registry::ParameterValues& values) {
  CUTICLE_TRY(check(casters, receivers));
  Transmittance result;
  result.values.assign(receivers.points.size(), 1.0f);
  result.standard_error.assign(receivers.points.size(), 0.0f);
  result.occluders.assign(receivers.points.size(), std::numeric_limits<float>::infinity());
  result.cost.device = cpu_device_name();
  if (casters.groom->strand_count() == 0) return result;
  const auto parameters = registry::from_values<Parameters>(values);
  const auto start = std::chrono::steady_clock::now();
  CUTICLE_ASSIGN(const auto rays, strands::RayGroom::build(*casters.groom));
  result.cost.build_ms = milliseconds_since(start);
  const auto built = std::chrono::steady_clock::now();
  trace_all(tracer_of(parameters, *rays, casters, receivers), receivers, result);
  result.cost.lookup_ms = milliseconds_since(built);
  return result;
}

}  // namespace

const Method& entry() {
  static const Method method{
      {registry::EntryKind::method, "truth", "mean over a disc of rays to the light, every fibre crossing counted",
       "Embree; docs/conventions.md", registry::table_of<Parameters>(), k_demands, registry::Stage::shadow},
      evaluate};
  return method;
}

}  // namespace cuticle::shadows::truth
