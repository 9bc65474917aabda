#version 460
#extension GL_GOOGLE_include_directive : require
// One workgroup of eight per tile: entries counted into bins of depth, about as many as there are entries, then each
// bin sorted by (depth, vertex), which no two entries share: the order does not depend on that in which they arrived.
// Shell's sort, so that many entries at one depth stay affordable. With slices, these are the bins, and within each the
// order is that of the vertices: near segments come early, so that few are looked at where they hide the others.
layout(local_size_x = 8) in;
#include "cuticle/render/passes/tile_lists/tile_of_group.glsl"

layout(std430, binding = 0) readonly buffer Offsets { uint offsets[]; };
layout(binding = 1) uniform usamplerBuffer entries;  // 1 / depth, first vertex: two texels each
layout(std430, binding = 2) coherent buffer Sorted { uvec2 ordered[]; };
layout(std430, binding = 3) writeonly buffer DepthRanges { vec2 depth_ranges[]; };

const uint k_lanes = 8u, k_most_bins = 512u;
const uint k_insertion = 8u;  // entries that one gap more does not pay for
shared uint bins[k_most_bins];
shared float nearest_of[k_lanes], farthest_of[k_lanes];
shared uint sum_of[k_lanes];

float depth_of(uint entry) { return uintBitsToFloat(texelFetch(entries, int(2u * entry)).r); }

// Greatest and least 1 / depth of the tile.
vec2 depth_range(uint lane, uint begin, uint end) {
  float nearest = 0.0, farthest = 3.0e38;
  for (uint k = begin + lane; k < end; k += k_lanes) {
    nearest = max(nearest, depth_of(k));
    farthest = min(farthest, depth_of(k));
  }
  nearest_of[lane] = nearest;
  farthest_of[lane] = farthest;
  barrier();
  for (uint k = 0u; k < k_lanes; ++k) {
    nearest = max(nearest, nearest_of[k]);
    farthest = min(farthest, farthest_of[k]);
  }
  return vec2(nearest, farthest);
}

// Counts become the places where the bins begin.
void add_up(uint lane, uint begin, uint bins_of_lane) {
  uint first = lane * bins_of_lane, sum = 0u;
  for (uint k = 0u; k < bins_of_lane; ++k) sum += bins[first + k];
  sum_of[lane] = sum;
  barrier();
  uint next = begin;
  for (uint k = 0u; k < lane; ++k) next += sum_of[k];
  for (uint k = 0u; k < bins_of_lane; ++k) {
    uint own = bins[first + k];
    bins[first + k] = next;
    next += own;
  }
  barrier();
}

// Positive floats order as their bits.
bool before(uvec2 a, uvec2 b) {
  bool nearer = push.slices == 0u && a.x > b.x, level = push.slices > 0u || a.x == b.x;
  return nearer || (level && a.y < b.y);
}

// Insertion among entries `gap` apart; `from` is the first place of the bin.
void insert(uint from, uint end, uint gap) {
  for (uint k = from + gap; k < end; ++k) {
    uvec2 own = ordered[k], other;
    uint place = k;
    for (; place >= from + gap; place -= gap) {
      other = ordered[place - gap];
      if (!before(own, other)) break;
      ordered[place] = other;
    }
    ordered[place] = own;
  }
}

void sort(uint begin, uint end) {
  uint gap = 1u;
  while (gap < (end - begin) / k_insertion) gap = 3u * gap + 1u;
  for (; gap > 1u; gap /= 3u) insert(begin, end, gap);
  insert(begin, end, 1u);
}

void main() {
  uint lane = gl_LocalInvocationID.x, tile = tile_of_group();
  uint begin = min(offsets[tile], push.capacity), end = min(offsets[tile + 1u], push.capacity);
  if (begin == end) return;
  vec2 range = depth_range(lane, begin, end);
  if (lane == 0u) depth_ranges[tile] = range;
  uint bins_of_lane = min(((push.slices > 0u ? push.slices : end - begin) + 7u) / 8u, k_most_bins / k_lanes);
  uint count = k_lanes * bins_of_lane, used = push.slices > 0u ? push.slices : count;
  float scale = range.x > range.y ? float(used) * 0.99999 / (range.x - range.y) : 0.0;
  for (uint k = lane; k < count; k += k_lanes) bins[k] = 0u;
  barrier();
  for (uint k = begin + lane; k < end; k += k_lanes)
    atomicAdd(bins[min(uint((range.x - depth_of(k)) * scale), used - 1u)], 1u);
  barrier();
  add_up(lane, begin, bins_of_lane);
  for (uint k = begin + lane; k < end; k += k_lanes) {
    uint place = atomicAdd(bins[min(uint((range.x - depth_of(k)) * scale), used - 1u)], 1u);
    ordered[place] = uvec2(texelFetch(entries, int(2u * k)).r, texelFetch(entries, int(2u * k + 1u)).r);
  }
  memoryBarrierBuffer();
  barrier();
  for (uint k = lane; k < count; k += k_lanes) sort(k == 0u ? begin : bins[k - 1u], bins[k]);  // now a bin's end
}
