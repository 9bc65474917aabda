#version 460
#extension GL_GOOGLE_include_directive : require
// Segments as two triangles each that face the light, an instance per light and opacity.
#define MAPS_BINDING 0
#include "render/passes/surface_shadow/surface_maps.glsl"
#include "render/finite.glsl"
#define VERTICES_BINDING 1
#include "strands/spline/drawn.glsl"
layout(std430, set = 0, binding = 2) readonly buffer Segments { uint segments[]; };
#include "render/passes/surface_shadow/hair_push.glsl"
layout(location = 0) flat out uint light;
layout(location = 1) flat out uint strand;
layout(location = 2) flat out uint opacity;

const uint k_end[6] = uint[](0u, 0u, 1u, 1u, 0u, 1u);
const float k_side[6] = float[](-1.0, 1.0, -1.0, -1.0, 1.0, 1.0);

void main() {
  const uint corner = uint(gl_VertexIndex) % 6u, first = segments[uint(gl_VertexIndex) / 6u * parts];
  const vec4 begin = drawn_vertex(first), end = drawn_vertex(first + parts), here = k_end[corner] == 0u ? begin : end;
  light = uint(gl_InstanceIndex) % light_count;
  opacity = uint(gl_InstanceIndex) / light_count;
  strand = first / vertices_per_strand;
  const vec3 sight = map_sight[light].xyz + map_sight[light].w * begin.xyz;
  const vec3 across = cross(end.xyz - begin.xyz, sight);
  const float size = length(across);
  const bool drawn = is_finite(begin) && is_finite(end) && size > 0.0;
  gl_Position = drawn ? map_clip(light, here.xyz + across * (k_side[corner] * here.w * width / size))
                      : vec4(2.0, 2.0, 2.0, 1.0);
  // The maps of an opacity lie below those of the one before.
  if (k_different > 1u)
    gl_Position.y = (gl_Position.y + float(1u + 2u * opacity) * gl_Position.w) / float(k_different) - gl_Position.w;
}
