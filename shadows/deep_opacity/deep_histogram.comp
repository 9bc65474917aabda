#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: projected length over the depth behind the nearest fibre, each piece counted at its middle.
layout(local_size_x = 64) in;
#include "cuticle/shadows/deep_opacity/layers.glslh"
#include "cuticle/shadows/map_segments.glsl"

layout(std430, binding = 3) readonly buffer Nearest { uint nearest[]; };
layout(std430, binding = 4) buffer Histogram { uint histogram[]; };

void piece(Footprint footprint) {
  const vec3 middle = piece_middle(footprint);
  if (!(middle.x >= 0.0 && middle.y >= 0.0 && middle.x < float(columns) && middle.y < float(rows))) return;
  const uint front = nearest[uint(middle.y) * columns + uint(middle.x)];
  const uint at = uint(max(0, int(floor(middle.z))));
  if (front != k_no_depth && at >= front)
    atomicAdd(histogram[min(at - front, k_depth_steps - 1u)], piece_weight(footprint.size));
}

void main() {
  const uint s = invocation();
  if (s < push.count) walk_segment(s, push.pieces_per_step);
}
