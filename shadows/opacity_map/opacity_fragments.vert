#version 460
#extension GL_GOOGLE_include_directive : require
// N19: two triangles a segment, which cover a row of texels of the fragments' target; tent weights at its ends.
#define MAP_IS_DRAWN
#include "shadows/map_geometry.glsl"
#include "shadows/lookup_place.glsl"
#include "shadows/opacity_map/tent_planes.glsl"

#define VERTICES_BINDING 0
#include "strands/spline/drawn.glsl"
layout(binding = 1) uniform usamplerBuffer segments;
layout(std430, binding = 2) readonly buffer Box { uint least[6]; };
layout(location = 0) out vec3 position;  // metres
layout(location = 1) out vec4 weights_of_vertex[4];
layout(location = 5) flat out uint segment;

const uvec2 k_corners[6] = uvec2[](uvec2(0, 0), uvec2(1, 0), uvec2(0, 1), uvec2(0, 1), uvec2(1, 0), uvec2(1, 1));

void main() {
  segment = uint(gl_VertexIndex) / 6u;
  const uint per_segment = uint(push.own[1]), side = uint(push.own[2]);
  const uvec2 corner = k_corners[gl_VertexIndex % 6];
  const int parts = int(segment_parts()), first = int(texelFetch(segments, int(segment) * parts).r);
  const vec4 from = drawn_vertex(uint(first)), to = drawn_vertex(uint(first + parts));
  position = corner.x == 0u ? from.xyz : to.xyz;
  const MapPlacement placement = placement_of(least);
  const LookupPlace place = lookup_place(position, to.xyz - from.xyz, from.w);
  const vec3 seen = in_light_axes(place.point);
  const float z = depth_looked_up(placement, place, seen, place_in_map(placement, seen).z);
  weights_of_vertex = tent_weights(clamp(z, 0.0, push.intervals));
  const uint per_row = side / per_segment;
  const uvec2 texel = uvec2((segment % per_row + corner.x) * per_segment, segment / per_row + corner.y);
  gl_Position = vec4(2.0 * vec2(texel) / float(side) - 1.0, 0.5, 1.0);
}
