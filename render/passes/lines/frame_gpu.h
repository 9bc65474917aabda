#pragma once
// What a frame tells the line shaders (lines_frame.glsl).
#include "render/lights_gpu.h"
#include "render/pass_gpu.h"
#include "render/passes/lines/lines.h"
#include "render/passes/lines/tables_gpu.h"

namespace cuticle::render::lines {

struct Frame {
  glm::mat4 world_to_clip;
  glm::vec4 eye;
  std::array<glm::vec4, k_most_tables> table_maps, table_scales;
  glm::vec4 multiple;
  std::uint32_t light_count, vertex_count, vertices_per_strand;
  float variation, tip_variation;
  std::uint32_t drawn_segments, packed_vertices;
  float opacity_of_radius;  ///< a strand's width over a line's, times depth, per metre of radius; 0: lines are opaque
  glm::vec2 caustic, unused;
  LightRows lights;
};
static_assert(sizeof(Frame) == 64 + 16 * 13 + 16 * 3 * k_most_lights);

/// What does not change between frames: texture coordinates, table scales and the tint of light scattered many times.
/// Error: bad_input as drawn_tables.
Result<Frame> constant_part(const Resources& resources);
/// Radiance per irradiance and `ambient_share` (ambient.glsl) of light that fibres of the model have scattered many
/// times; `strength`: the parameter `ambient`. Error: of the model.
Result<glm::vec4> multiple_scattering(const bsdf::Model& model, const registry::ParameterValues& values,
                                      double strength);
/// Adds camera and lights.
void set_view(Frame& frame, const Resources& resources);

/// F10: what of the strands a frame draws.
struct DrawnPart {
  std::uint32_t strands = 0, segments = 0;  ///< the first of them; of each
  double width = 1;                         ///< factor that makes up for the strands left out
};
/// All where the strands cover `full_px` pixels, or where it is 0. Widths go in steps of the fourth root
/// of 2, each with as many strands as cover the area of all.
DrawnPart drawn_part(const Resources& resources, double full_px);
/// Line width in supersampled pixels: as given, or that of the widest strand where it may be nearest in this frame, up
/// to the next fourth root of 2, at least one supersample and at most `widest_px`.
float line_width(const Resources& resources);
/// What a radius is multiplied by, over its depth, for the opacity of its strand: its width over that of a line, which
/// is `width` supersamples. 0, all opaque, where the parameter `width_px` gives a width.
float opacity_of_radius(const Resources& resources, const DrawnPart& part, float width);
inline constexpr float k_widest_lines = 8;  ///< supersamples; devices with wide lines have 8 at least
/// A width times a factor of at least 1, up to k_widest_lines.
float widened(float width, double factor);

}  // namespace cuticle::render::lines
