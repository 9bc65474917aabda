#version 460
#extension GL_GOOGLE_include_directive : require
// One work group: the ends of the layers, from their shares of the hair, by the histogram of depths, or of its depth.
layout(local_size_x = 64) in;
#include "shadows/deep_opacity/layers.glslh"
#include "shadows/map_geometry.glsl"
#include "shadows/splat.glslh"

layout(std430, binding = 0) readonly buffer Table { uint table[]; };  // deposits, then the layers' shares
layout(std430, binding = 1) readonly buffer Histogram { uint histogram[]; };
layout(std430, binding = 2) writeonly buffer Ends { uint ends_of_layers[]; };  // the coverage by a fibre, the table

const uint k_lanes = 64u, k_steps_per_lane = k_depth_steps / k_lanes;
shared uint before[k_lanes + 1u];  // the sum before each lane's steps, and the total
shared uint deepest[k_lanes];
shared uint crossing[k_max_layers];
shared LayerEnds ends;

/// Of the hair or of its depth, before the end of layer i, in 65536ths.
uint share_of(uint i) { return table[k_coverage_steps + 1u + i]; }

void sum_steps(uint lane) {
  uint sum = 0u, last = 0u;
  for (uint step = lane * k_steps_per_lane; step < (lane + 1u) * k_steps_per_lane; ++step) {
    sum += histogram[step];
    if (histogram[step] > 0u) last = step + 1u;
  }
  before[lane + 1u] = sum;
  deepest[lane] = last;
  if (lane < k_max_layers) crossing[lane] = k_depth_steps;
}

/// Each lane marks the targets that its own steps reach first.
void find_crossings(uint lane) {
  const uint total = before[k_lanes];
  uint sum = before[lane];
  for (uint step = lane * k_steps_per_lane; step < (lane + 1u) * k_steps_per_lane; ++step) {
    sum += histogram[step];
    for (uint i = 0u; i < push.layers; ++i)
      if (sum >= part_of(total, share_of(i), 65536u)) atomicMin(crossing[i], step + 1u);
  }
}

void write_ends() {
  uint depth = 1u;
  for (uint lane = 0u; lane < k_lanes; ++lane) depth = max(depth, deepest[lane]);
  ends.count = push.layers;
  for (uint i = 0u; i < push.layers; ++i)
    ends.end[i] = (push.flags & k_equal_opacity_flag) != 0u ? crossing[i] : shared_end(depth, share_of(i));
  ends = rising(ends);
  for (uint i = 0u; i < k_max_layers; ++i) ends_of_layers[i] = ends.end[i];
  ends_of_layers[k_max_layers] = fibre_coverage(histogram[k_weights], histogram[k_coverages]);
}

void main() {
  const uint lane = gl_LocalInvocationID.x;
  if (lane == 0u) before[0] = 0u;
  sum_steps(lane);
  barrier();
  if (lane == 0u)
    for (uint i = 0u; i < k_lanes; ++i) before[i + 1u] += before[i];
  barrier();
  find_crossings(lane);
  barrier();
  if (lane == 0u) write_ends();
  barrier();
  for (uint step = lane; step < k_depth_steps; step += k_lanes)
    ends_of_layers[k_layer_table + step] = packed_layer(layer_at(ends, step));
}
