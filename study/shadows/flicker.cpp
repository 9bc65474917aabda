#include "study/shadows/flicker.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "study/shadows/comparison.h"
// After the headers that include glm/matrix.hpp: the dialect defines Vec2 and Vec3.
#include "core/registry/find_value.h"
#include "shadows/map_view.h"

namespace cuticle::study {
namespace {

/// The mean of |change(i)| over the receivers counted.
double mean_change(std::span<const float> truth, const auto& change) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (is_counted(truth[i], Counted::partly_lit)) {
      sum += std::abs(change(i));
      ++count;
    }
  return count == 0 ? 0 : sum / double(count);
}

/// Strands that reach no side of the light's box, moved sideways by `distance` texels of a map of `resolution`.
strands::Groom moved(const strands::Groom& groom, const glm::dvec3& to_light, double distance,
                     std::uint32_t resolution) {
  const shadows::LightAxes axes = shadows::light_axes(to_light);
  const shadows::LightBox box = shadows::light_box(axes, groom.positions);
  const float texels_per_metre = shadows::map_view(axes, box, resolution, 1).scale.x;
  const glm::vec3 move = float(distance) / texels_per_metre * axes.right;
  strands::Groom result = groom;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    bool spans = false;
    for (const glm::vec3& position : groom.strand(s)) {
      const glm::vec3 p = shadows::view_point(axes, position);
      for (int axis = 0; axis < 3; ++axis) spans |= p[axis] <= box.lower[axis] || p[axis] >= box.upper[axis];
    }
    for (std::uint32_t v = groom.offsets[s]; !spans && v < groom.offsets[s + 1]; ++v) result.positions[v] += move;
  }
  return result;
}

}  // namespace

glm::dvec3 turned_light(const glm::dvec3& to_light) {
  const double angle = 0.1 * std::numbers::pi / 180;
  return std::cos(angle) * to_light + std::sin(angle) * shadows::plane_axes(to_light).first;
}

Result<Flicker> measure_flicker(const Candidate& candidate, const FlickerScene& scene, std::span<const float> values) {
  Flicker flicker;
  shadows::Casters turned = scene.casters;
  turned.to_light = turned_light(turned.to_light);
  CUTICLE_ASSIGN(const auto light, evaluate_at(candidate, turned, *scene.probes, scene.weights));
  flicker.light = mean_change(scene.truth, [&](std::size_t i) {
    return double(light.values[i]) - double(values[i]) - double(scene.turned_truth[i]) + double(scene.truth[i]);
  });
  const auto resolution = registry::find_value<std::int64_t>(candidate.values, "resolution");
  if (!resolution) return flicker;
  const strands::Groom groom = moved(*scene.casters.groom, scene.casters.to_light, 0.1, std::uint32_t(*resolution));
  shadows::Casters casters = scene.casters;
  casters.groom = &groom;
  CUTICLE_ASSIGN(const auto motion, evaluate_at(candidate, casters, on_groom(groom, *scene.probes), scene.weights));
  flicker.motion =
      mean_change(scene.truth, [&](std::size_t i) { return double(motion.values[i]) - double(values[i]); });
  return flicker;
}

}  // namespace cuticle::study
