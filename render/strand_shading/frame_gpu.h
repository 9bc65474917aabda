#pragma once
// What a frame tells the line shaders (frame.glsl).
#include "render/lights_gpu.h"
#include "render/pass_gpu.h"
#include "render/passes/lines/lines.h"
#include "render/strand_shading/tables_gpu.h"

namespace cuticle::render::strand_shading {

struct Frame {
  glm::mat4 world_to_clip;
  glm::vec4 eye;
  std::array<glm::vec4, k_max_tables> table_maps, table_scales;
  glm::vec4 multiple;
  std::uint32_t light_count, vertex_count, vertices_per_strand;
  float variation, tip_variation;
  std::uint32_t drawn_segments, packed_vertices;
  float opacity_of_radius;  ///< a strand's width over a line's, times depth, per metre of radius; 0: lines are opaque
  glm::vec2 caustic, unused;
  LightRows lights;
};
static_assert(sizeof(Frame) == 64 + 16 * 13 + 16 * 3 * k_max_lights);

/// What does not change between frames: texture coordinates, table scales and the tint of light scattered many times.
/// Error: bad_input as drawn_tables.
Result<Frame> constant_part(const Resources& resources);
/// Radiance per irradiance and `multiple_scattering_share` (ambient.glsl) of light that fibres of the model have
/// scattered many times; `strength`: the parameter `ambient`. Error: of the model.
Result<glm::vec4> multiple_scattering(const bsdf::Model& model, const registry::ParameterValues& values,
                                      double strength);
/// Adds camera and lights.
void set_view(Frame& frame, const Resources& resources);

}  // namespace cuticle::render::strand_shading
