#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: deposits into the intervals between slices by integer sums, and the sums of the mean fibre.
layout(local_size_x = 64) in;
#include "shadows/fibres.glslh"
#include "shadows/map_splat.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) buffer Sums { uint sums[]; };
layout(std430, binding = 5) buffer Fibre { uint fibre_weights, fibre_coverages; };

void deposit(uint texel, uint covered, uint depth_step) {
  if (depth_step < push.layers && is_kept(texel))
    atomicAdd(sums[kept_place(texel) * push.layers + depth_step], table[covered]);
}

void count_fibre(uint s) {
  const MapSegment segment = map_segment(s);
  const uint weight = piece_weight(segment_footprint(segment.a, segment.b, segment.half_width, 0.0, 0.0).size);
  atomicAdd(fibre_weights, weight);
  atomicAdd(fibre_coverages, weight * middle_coverage(segment.half_width));
}

void main() {
  const uint s = invocation();
  if (s >= push.count) return;
  if (strip_number() == 0u && is_sampled(s)) count_fibre(s);
  walk_segment(s, push.pieces_per_step);
}
