#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: deposits into the intervals between slices by integer sums.
layout(local_size_x = 64) in;
#include "cuticle/shadows/opacity_map/opacity_geometry.glsl"
#include "cuticle/shadows/opacity_map/splat.glslh"

layout(std430, binding = 0) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 1) readonly buffer Segments { uint segments[]; };
layout(std430, binding = 2) readonly buffer Table { uint table[]; };
layout(std430, binding = 3) readonly buffer Box { uint least[6]; };
layout(std430, binding = 4) buffer Sums { uint sums[]; };

vec3 place(MapPlacement placement, vec3 p) {
  const vec3 point = place_in_map(placement, in_light_axes(p));
  return vec3(snap(point.x), snap(point.y), point.z);
}

void deposit(Footprint footprint, int i, int j) {
  const vec2 offset = texel_offset(footprint.from, i, j);
  const uint amount = table[coverage_index(coverage(footprint, offset))];
  const int bin = max(0, depth_bin(footprint, offset));
  if (amount == 0u || bin >= int(push.layers)) return;
  atomicAdd(sums[(uint(j) * push.resolution + uint(i)) * push.layers + uint(bin)], amount);
}

void splat(Footprint footprint) {
  const Reach reach = footprint_reach(footprint);
  const int end = int(push.resolution) - 1;
  for (int m = max(0, reach.first); m <= min(end, reach.last); ++m) {
    const int last = min(end, minor_bound(footprint, reach, m, 1.0));
    for (int n = max(0, minor_bound(footprint, reach, m, -1.0)); n <= last; ++n)
      deposit(footprint, reach.steep ? n : m, reach.steep ? m : n);
  }
}

void main() {
  const uint s = invocation();
  if (s >= push.count) return;
  const uint v = segments[s];
  const bool is_first = s == 0u || segments[s - 1u] + 1u != v;
  const bool is_last = s + 1u == push.count || segments[s + 1u] != v + 1u;
  const MapPlacement placement = placement_of(least);
  const vec3 a = place(placement, vertices[v].xyz), b = place(placement, vertices[v + 1u].xyz);
  precise float radius_sum = vertices[v].w + vertices[v + 1u].w;
  precise float half_width = 0.5 * radius_sum * placement.scale.x;
  const uint pieces = piece_count(a.z, b.z, segment_footprint(a, b, half_width, 0.0, 0.0).size);
  for (uint i = 0u; i < pieces; ++i)
    splat(segment_footprint(piece_point(a, b, i, pieces), piece_point(a, b, i + 1u, pieces), half_width,
                            is_first && i == 0u ? 1.0 : 0.0, is_last && i + 1u == pieces ? 1.0 : 0.0));
}
