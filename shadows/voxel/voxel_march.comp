#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the rays from its disc of T through the volume.
layout(local_size_x = 64) in;
#include "core/shared/disc.glslh"
#include "shadows/map_segment.glsl"
#include "shadows/own_segments.glsl"
#include "shadows/voxel/segment_deposit.glsl"
#define STRAND_LIST_BINDING 6
#include "strands/lod/strand_list.glsl"

layout(std430, binding = 4) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 5) writeonly buffer Transmittance { float transmittance[]; };

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

vec3 receiver;
float visit_own_vertex(uint v) {
  const vec3 away = drawn_vertex(v).xyz - receiver;
  return length(away - dot(away, push.forward.xyz) * push.forward.xyz);
}

void return_to_own_vertex() {}
void visit_own_segment(uint s, bool backward, bool is_first, bool is_last) {}

/// What the samples of a ray read of the receiver's own fibre.
float own_samples(vec3 entry, vec3 direction, float span) {
  float sum = 0.0;
  for (uint s = own_begin; s < own_end; ++s) {
    const SegmentDeposit deposit = segment_deposit(placement, s);
    for (uint i = 0u; i < deposit.lanes * deposit.pieces; ++i) {
      const vec3 cell = cell_of(placement, deposit_place(placement, deposit, i));
      sum += float(deposit.amount) * weight_of_cell(cell, entry, direction, span);
    }
  }
  return sum;
}

float transmittance_from(vec3 position, vec3 direction) {
  const vec3 start = in_cells(placement, position);
  const vec2 inside = span_inside(start, direction);
  const vec3 entry = start + inside.x * direction;
  const float span = inside.y - inside.x;
  float sum = 0.0;
  for (float t = 0.5 * k_ray_step; t < span; t += k_ray_step) sum += sample_at(entry + t * direction);
  sum = max(0.0, sum - own_samples(entry, direction, span));
  return exp(-sum * k_ray_step / float(k_units));
}

void main() {
  const uint v = listed_vertex(invocation());
  if (v >= push.count) return;
  placement = volume_placement(lower_of(least), upper_of(least), push.resolution);
  receiver = drawn_vertex(v).xyz;
  const OwnPlace own = own_place(v);
  const LookupPlace place = lookup_place(receiver, own.s, own.at);
  const vec3 from = place.point - place.held * push.forward.xyz;
  find_own_segments(own.s, own.at, push.filter_radius + k_own_cells * placement.cell + drawn_vertex(v).w,
                    placement.cell);
  precise float cells = push.filter_radius * placement.per_metre;
  const int count = ray_count(cells);
  float sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const vec2 place = count == 1 ? vec2(0.0) : push.filter_radius * disc_point(uint(i), uint(count), 0.0);
    const vec3 start = place.x * push.right.xyz + place.y * push.up.xyz;
    sum += transmittance_from(from + start, -push.forward.xyz);
  }
  transmittance[v] = sum / float(count);
}
