#include "render/passes/lines/frame_gpu.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include "render/passes/bake_tables/bake_tables_gpu.h"
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

Result<Frame> constant_part(const Resources& resources) {
  const FibreMaterial& material = resources.get<FibreMaterial>();
  const DrawnHair& hair = resources.get<DrawnHair>();
  const auto parameters = parameters_of<Parameters>(resources);
  Frame frame{};
  frame.variation = float(parameters.variation);
  frame.tip_variation = float(parameters.tip_variation);
  frame.vertices_per_strand = hair.vertices_per_strand;
  frame.vertex_count = hair.strands.vertex_count;
  if (material.evaluates_directly) {
    CUTICLE_ASSIGN(frame.multiple, multiple_scattering(*material.model, *material.values, parameters.ambient));
    return frame;
  }
  if (!bake_tables::table_set_of(resources)) return frame;
  const lut::TableSet& set = *bake_tables::table_set_of(resources);
  CUTICLE_ASSIGN(const DrawnTables drawn, drawn_tables(set));
  frame.table_maps = drawn.maps;
  frame.table_scales = drawn.scales;
  frame.caustic = drawn.caustic;
  CUTICLE_ASSIGN(frame.multiple, multiple_scattering(*set.model, set.values, parameters.ambient));
  return frame;
}

void set_view(Frame& frame, const Resources& resources) {
  const FrameView& view = resources.get<FrameView>();
  const Lights& lights = resources.get<Lights>();
  frame.world_to_clip = glm::mat4(projection_matrix(view.camera) * view_matrix(view.camera));
  frame.eye = glm::vec4(view.camera.position, 1);
  frame.light_count = std::uint32_t(lights.all.size());
  frame.lights = light_rows(lights.all);
}

DrawnPart drawn_part(const Resources& resources, double full_px) {
  const DrawnHair& hair = resources.get<DrawnHair>();
  constexpr double k_least_share = 0.01;
  const std::uint32_t size = hair.vertices_per_strand;
  DrawnPart part{hair.strands.vertex_count / std::max(1u, size), std::max(1u, size) - 1};
  if (full_px == 0 || part.strands == 0) return part;
  const double covered_px = strands::covered_pixels(hair.strands.bounds, resources.get<FrameView>().camera);
  const double share = strands::drawn_share<double>(covered_px, full_px, k_least_share);
  const double steps = std::floor(4 * std::log2(1 / share));
  part.width = std::exp2(steps / 4);
  part.strands = strands::drawn_strands(part.strands, float(1 / part.width));
  part.segments = std::uint32_t(strands::drawn_vertices<double>(size, 1 / part.width)) - 1;
  return part;
}

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

float opacity_of_radius(const Resources& resources, const DrawnPart& part, float width) {
  if (parameters_of<Parameters>(resources).width_px > 0) return 0;
  return float(2 * texels_at_a_metre(resources) * part.width / double(width));
}

float widened(float width, double factor) { return std::max(width, std::min(width * float(factor), k_widest_lines)); }

}  // namespace cuticle::render::lines
