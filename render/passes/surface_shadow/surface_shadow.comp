#version 460
#extension GL_GOOGLE_include_directive : require
// What surfaces leave of a light at each vertex of the strands, beside what hair leaves of it.
#define MAPS_BINDING 0
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/finite.glsl"
#include "render/passes/surface_shadow/map_lookup.glsl"
#include "render/passes/surface_shadow/surface_maps.glsl"
#define VERTICES_BINDING 1
#include "strands/spline/drawn.glsl"
layout(std430, set = 0, binding = 2) writeonly buffer Visibility { float visibility[]; };
layout(std430, set = 0, binding = 3) buffer Transmittance { float transmittance[]; };
layout(std430, set = 0, binding = 4) buffer OfSecond { float of_second[]; };  // transmittance of other opacities
layout(std430, set = 0, binding = 5) buffer OfThird { float of_third[]; };
layout(set = 0, binding = 6) uniform sampler2D map;
#define UNSHADOWED unshadowed
#define MAP_DEPTH(x, y) texelFetch(map, ivec2(x, y), 0).r
#include "render/passes/surface_shadow/unshadowed.glsl"
#define CHANNEL_CONSTANT 0
#include "render/channels.glsl"
layout(push_constant) uniform Push {
  uint vertex_count, light;
  float half_side;
};

void main() {
  const uint vertex = invocation();
  if (vertex >= vertex_count) return;
  float lit = 1.0;
  if (is_finite(drawn_vertex(vertex))) {
    vec3 at = place_in_light_map(world_to_map[light] * vec4(drawn_vertex(vertex).xyz, 1.0), map_bias[light]);
    lit = unshadowed(at, light, map_resolution, map_columns, half_side);
  }
  visibility[light * vertex_count + vertex] = lit;
  transmittance[vertex] *= lit;
  if (k_different > 1u) of_second[vertex] *= lit;
  if (k_different > 2u) of_third[vertex] *= lit;
}
