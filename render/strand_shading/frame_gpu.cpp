#include "render/strand_shading/frame_gpu.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/lines/lines.h"

namespace cuticle::render::strand_shading {

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
  const auto parameters = parameters_of<lines::Parameters>(resources);
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

}  // namespace cuticle::render::strand_shading
