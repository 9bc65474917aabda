#include "render/passes/lines/line_width_gpu.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "render/passes/lines/lines.h"
#include "render/visibility/drawn_part_gpu.h"

namespace cuticle::render::lines {

namespace {

/// Supersamples across a metre that is a metre away.
double texels_at_a_metre(const Resources& resources) {
  const Camera& camera = resources.get<FrameView>().camera;
  return camera.resolution.y * resources.get<Targets>().supersampling /
         (2 * std::tan(camera.vertical_field_of_view / 2));
}

/// Depth at which the strands may begin, at least a quarter of the target's.
double nearest_depth(const Resources& resources) {
  const DrawnHair& hair = resources.get<DrawnHair>();
  constexpr double k_least = 0.25;
  const Camera& camera = resources.get<FrameView>().camera;
  const double target = glm::distance(camera.position, camera.target);
  const glm::dvec3 forward = (camera.target - camera.position) / std::max(target, 1e-9);
  double nearest = target;
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = double((corner >> axis & 1) ? hair.strands.bounds.upper[axis] : hair.strands.bounds.lower[axis]);
    nearest = std::min(nearest, glm::dot(point - camera.position, forward));
  }
  return std::max(nearest, k_least * target);
}

}  // namespace

float line_width(const Resources& resources) {
  const Targets& targets = resources.get<Targets>();
  const auto parameters = parameters_of<Parameters>(resources);
  if (parameters.width_px > 0) return float(parameters.width_px * targets.supersampling);
  const double width = 2 * resources.get<DrawnHair>().radius * texels_at_a_metre(resources) / nearest_depth(resources);
  const double step = std::exp2(std::ceil(4 * std::log2(std::max(width, 1.0))) / 4);
  return float(std::max(1.0, std::min(step, parameters.widest_px * targets.supersampling)));
}

float opacity_of_radius(const Resources& resources, const visibility::DrawnPart& part, float width) {
  if (parameters_of<Parameters>(resources).width_px > 0) return 0;
  return float(2 * texels_at_a_metre(resources) * part.width / double(width));
}

float widened(float width, double factor) { return std::max(width, std::min(width * float(factor), k_max_line_width)); }

}  // namespace cuticle::render::lines
