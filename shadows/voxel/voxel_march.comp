#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the rays from its disc of T through the volume.
layout(local_size_x = 64) in;
#include "core/shared/disc.glslh"
#include "shadows/map_geometry.glsl"
#include "shadows/voxel/volume.glslh"

layout(binding = 0) uniform samplerBuffer vertices;
layout(std430, binding = 1) readonly buffer Box { uint least[6]; };
layout(std430, binding = 2) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 3) writeonly buffer Transmittance { float transmittance[]; };

const float k_step = 0.5;

VolumePlacement placement;

/// Trilinear between the middles of cells, 0 outside.
float sample_at(vec3 p) {
  const vec3 corner = floor(p - 0.5);
  float sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    const vec3 cell = corner + vec3(i & 1, (i >> 1) & 1, i >> 2);
    if (any(lessThan(cell, vec3(0))) || any(greaterThanEqual(cell, placement.size))) continue;
    const vec3 weight = 1.0 - abs(p - 0.5 - cell);
    sum += weight.x * weight.y * weight.z * float(sums[cell_number(placement, cell)]);
  }
  return sum;
}

/// Where a ray is inside the box; x: enters, y: leaves, not above x where it misses.
vec2 span_inside(vec3 p, vec3 direction) {
  vec2 span = vec2(0.0, 3e38);
  for (int axis = 0; axis < 3; ++axis) {
    const float to_lower = -0.5 - p[axis], to_upper = placement.size[axis] + 0.5 - p[axis];
    if (direction[axis] == 0.0) {
      if (to_lower > 0.0 || to_upper < 0.0) span.y = 0.0;
      continue;
    }
    const float a = to_lower / direction[axis], b = to_upper / direction[axis];
    span = vec2(max(span.x, min(a, b)), min(span.y, max(a, b)));
  }
  return span;
}

float transmittance_from(vec3 position, vec3 direction) {
  const vec3 start = in_cells(placement, position);
  const vec2 inside = span_inside(start, direction);
  const vec3 entry = start + inside.x * direction;
  float sum = 0.0;
  for (float t = 0.5 * k_step; t < inside.y - inside.x; t += k_step) sum += sample_at(entry + t * direction);
  return exp(-sum * k_step / float(k_units));
}

void main() {
  const uint v = invocation();
  if (v >= push.count) return;
  placement = volume_placement(lower_of(least), upper_of(least), push.resolution);
  precise float cells = push.filter_radius * placement.per_metre;
  const int count = ray_count(cells);
  float sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const vec2 place = count == 1 ? vec2(0.0) : push.filter_radius * disc_point(uint(i), uint(count), 0.0);
    const vec3 start = place.x * push.right.xyz + place.y * push.up.xyz;
    sum += transmittance_from(texelFetch(vertices, int(v)).xyz + start, -push.forward.xyz);
  }
  transmittance[v] = sum / float(count);
}
