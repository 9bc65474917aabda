#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment that is counted: projected length over the depth behind the nearest fibre, each piece counted at its middle.
layout(local_size_x = 64) in;
#include "shadows/deep_opacity/layers.glslh"
#include "shadows/map_segments.glsl"

layout(binding = 3) uniform usamplerBuffer depths;
layout(std430, binding = 4) buffer Histogram { uint histogram[]; };

bool sampled;  // the segment

void piece(Footprint footprint) {
  const vec3 middle = piece_middle(footprint);
  if (!(middle.x >= 0.0 && middle.y >= 0.0 && middle.x < float(columns) && middle.y < float(rows))) return;
  const int texel = int(2u * (uint(middle.y) * columns + uint(middle.x)));
  const uint nearest = texelFetch(depths, texel).r, extent = found_extent(nearest, texelFetch(depths, texel + 1).r);
  const uint at = uint(max(0, int(floor(middle.z)))), weight = piece_weight(footprint.size);
  if (nearest != k_no_depth && at >= nearest)
    atomicAdd(histogram[table_step(layer_step(at - nearest, extent, (push.flags & k_by_texel_flag) != 0u))], weight);
  if (!sampled) return;
  atomicAdd(histogram[k_weights], weight);
  atomicAdd(histogram[k_coverages], weight * middle_coverage(footprint.half_width));
}

void main() {
  const uint i = invocation();
  const uint s = counted_run(i / k_counted_run, one_in(push.count)) + i % k_counted_run;
  sampled = is_sampled(s);
  if (s < push.count) walk_segment(s, push.pieces_per_step);
}
