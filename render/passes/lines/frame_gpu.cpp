#include "render/passes/lines/frame_gpu.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include "strands/lod/lod.glslh"
#include "strands/lod/lod.h"

namespace cuticle::render::lines {

namespace {

/// Share of light that a fibre lit and seen across scatters in total.
Result<glm::dvec3> albedo(const bsdf::Model& model, const registry::ParameterValues& values) {
  const bsdf::Point across;
  glm::dvec3 result{0};
  CUTICLE_TRY(bsdf::evaluate(model, values, bsdf::Precision::f64,
                             {.quantity = bsdf::Quantity::albedo, .points = {&across, 1}}, {&result, 1}));
  return glm::clamp(result, 0.0, 1.0);
}

}  // namespace

// An isotropic fibre of albedo a has S = a / pi^2. Light that reaches the eye after about three scatterings is tinted
// a^3.
Result<glm::vec4> multiple_scattering(const bsdf::Model& model, const registry::ParameterValues& values,
                                      double strength) {
  if (strength == 0) return glm::vec4(0);
  CUTICLE_ASSIGN(const glm::dvec3 once, albedo(model, values));
  return glm::vec4(once * once * once * (strength / (std::numbers::pi * std::numbers::pi)), 0);
}

Result<Frame> constant_part(const FrameResources& resources) {
  const auto parameters = parameters_of<Parameters>(resources);
  Frame frame{};
  frame.variation = float(parameters.variation);
  frame.tip_variation = float(parameters.tip_variation);
  frame.vertices_per_strand = resources.vertices_per_strand;
  frame.vertex_count = resources.strands.vertex_count;
  if (resources.evaluates_directly) {
    CUTICLE_ASSIGN(frame.multiple, multiple_scattering(*resources.model, *resources.model_values, parameters.ambient));
    return frame;
  }
  if (!resources.table_set) return frame;
  const lut::TableSet& set = *resources.table_set;
  CUTICLE_ASSIGN(const DrawnTables drawn, drawn_tables(set));
  frame.table_maps = drawn.maps;
  frame.table_scales = drawn.scales;
  frame.caustic = drawn.caustic;
  CUTICLE_ASSIGN(frame.multiple, multiple_scattering(*set.model, set.values, parameters.ambient));
  return frame;
}

void set_view(Frame& frame, const FrameResources& resources) {
  frame.world_to_clip = glm::mat4(projection_matrix(resources.camera) * view_matrix(resources.camera));
  frame.eye = glm::vec4(resources.camera.position, 1);
  frame.light_count = std::uint32_t(resources.lights.size());
  frame.lights = light_rows(resources.lights);
}

DrawnPart drawn_part(const FrameResources& resources, double full_px) {
  constexpr double k_least_share = 0.01;
  const std::uint32_t size = resources.vertices_per_strand;
  DrawnPart part{resources.strands.vertex_count / std::max(1u, size), std::max(1u, size) - 1};
  if (full_px == 0 || part.strands == 0) return part;
  const double covered_px = strands::covered_pixels(resources.strands.bounds, resources.camera);
  const double share = strands::drawn_share<double>(covered_px, full_px, k_least_share);
  const double steps = std::floor(4 * std::log2(1 / share));
  part.width = std::exp2(steps / 4);
  part.strands = strands::drawn_strands(part.strands, float(1 / part.width));
  part.segments = std::uint32_t(strands::drawn_vertices<double>(size, 1 / part.width)) - 1;
  return part;
}

namespace {

/// Supersamples across a metre that is a metre away.
double texels_at_a_metre(const FrameResources& resources) {
  const Camera& camera = resources.camera;
  return camera.resolution.y * resources.supersampling / (2 * std::tan(camera.vertical_field_of_view / 2));
}

/// Depth at which the strands may begin, at least a quarter of the target's.
double nearest_depth(const FrameResources& resources) {
  constexpr double k_least = 0.25;
  const Camera& camera = resources.camera;
  const double target = glm::distance(camera.position, camera.target);
  const glm::dvec3 forward = (camera.target - camera.position) / std::max(target, 1e-9);
  double nearest = target;
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] =
          double((corner >> axis & 1) ? resources.strands.bounds.upper[axis] : resources.strands.bounds.lower[axis]);
    nearest = std::min(nearest, glm::dot(point - camera.position, forward));
  }
  return std::max(nearest, k_least * target);
}

}  // namespace

float line_width(const FrameResources& resources) {
  const auto parameters = parameters_of<Parameters>(resources);
  if (parameters.width_px > 0) return float(parameters.width_px * resources.supersampling);
  const double width = 2 * resources.strand_radius * texels_at_a_metre(resources) / nearest_depth(resources);
  const double step = std::exp2(std::ceil(4 * std::log2(std::max(width, 1.0))) / 4);
  return float(std::max(1.0, std::min(step, parameters.widest_px * resources.supersampling)));
}

float opacity_of_radius(const FrameResources& resources, const DrawnPart& part, float width) {
  if (parameters_of<Parameters>(resources).width_px > 0) return 0;
  return float(2 * texels_at_a_metre(resources) * part.width / double(width));
}

float widened(float width, double factor) { return std::max(width, std::min(width * float(factor), k_widest_lines)); }

}  // namespace cuticle::render::lines
