#version 460
#extension GL_GOOGLE_include_directive : require
// One workgroup per tile, of eight in software: entries counted into bins of depth, about as many as there are entries, then sorted
// by (depth, vertex), which no two entries share: the order does not depend on that in which they arrived. Shell's sort,
// so that many entries at one depth stay affordable. With slices, these are the bins, and within each the order is that
// of the vertices: near segments come early, so that few are looked at where they hide the others.
layout(local_size_x_id = 0) in;
#include "render/passes/tile_lists/tile_of_group.glsl"

layout(std430, binding = 0) readonly buffer Offsets { uint offsets[]; };
layout(binding = 1) uniform usamplerBuffer entries;  // 1 / depth, first vertex: two texels each
layout(std430, binding = 2) coherent buffer Sorted { uvec2 ordered[]; };
layout(std430, binding = 3) writeonly buffer DepthRanges { vec2 depth_ranges[]; };

layout(constant_id = 0) const uint k_lanes = 8u;
layout(constant_id = 1) const uint k_bins_of_lane = 64u;  // at most; odd where many lanes read theirs at once
const uint k_max_bins = k_lanes * k_bins_of_lane;
const uint k_insertion = 16u;  // entries that one gap more does not pay for
shared uint bins[k_max_bins];
shared float nearest_of[k_lanes], farthest_of[k_lanes];
shared uint sum_of[k_lanes], most_of[k_lanes];

float nearest, bins_per_depth;
uint used_bins;
uint bin_of(float depth) { return min(uint((nearest - depth) * bins_per_depth), used_bins - 1u); }

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

// Counts become the places where the bins begin; the greatest of them.
uint add_up(uint lane, uint begin, uint bins_of_lane) {
  uint first = lane * bins_of_lane, sum = 0u, most = 0u;
  for (uint k = 0u; k < bins_of_lane; ++k) {
    sum += bins[first + k];
    most = max(most, bins[first + k]);
  }
  sum_of[lane] = sum;
  most_of[lane] = most;
  barrier();
  uint next = begin;
  for (uint k = 0u; k < lane; ++k) next += sum_of[k];
  for (uint k = 0u; k < k_lanes; ++k) most = max(most, most_of[k]);
  for (uint k = 0u; k < bins_of_lane; ++k) {
    uint own = bins[first + k];
    bins[first + k] = next;
    next += own;
  }
  barrier();
  return most;
}

// Positive floats order as their bits; by slices, entries of different ones are compared only where they are in order.
bool before(uvec2 a, uvec2 b) {
  float depth_a = uintBitsToFloat(a.x), depth_b = uintBitsToFloat(b.x);
  bool nearer = a.x > b.x, level = a.x == b.x;
  if (push.slices > 0u) {
    uint slice_a = bin_of(depth_a), slice_b = bin_of(depth_b);
    nearer = slice_a < slice_b;
    level = slice_a == slice_b;
  }
  return nearer || (level && a.y < b.y);
}

// Insertion among entries `gap` apart, one comparison, load and store a turn: lanes wait for the one with most of them,
// not at every entry. `own` goes to `place` or farther; `top` is the last of what is in order before its first place k.
void insert(uint from, uint end, uint gap) {
  uint first = from, k = from, place = from;
  uvec2 own = uvec2(0u), other = uvec2(0u), top = uvec2(0u);
  if (from < end) own = ordered[from];
  do {
    bool moves = place >= first + gap && before(own, other), stays = place == k;
    if (k < end && (moves || !stays)) ordered[place] = moves ? other : own;
    if (!moves && stays) top = own;
    if (!moves) k += gap;
    if (k >= end) k = ++first;
    place = moves ? place - gap : k;
    uint next = moves ? max(place, from + gap) - gap : k;
    uvec2 loaded = uvec2(0u);
    if (next < end) loaded = ordered[next];
    own = moves ? own : loaded;
    other = moves ? loaded : top;
  } while (first < min(from + gap, end));
  if (place < k && k < end) ordered[place] = own;  // where turns ran out
}

// Where the bin of the entry at a place begins: all of a bin's entries go to one lane.
uint begin_of_bin(uint place, uint begin, uint end) {
  if (place <= begin || place >= end) return min(max(place, begin), end);
  uint bin = bin_of(uintBitsToFloat(ordered[place].x));
  return bin == 0u ? begin : bins[bin - 1u];  // now a bin's end
}

// An equal share of the entries each; `most`: of one bin.
void sort(uint lane, uint begin, uint end, uint most) {
  uint each = (end - begin + k_lanes - 1u) / k_lanes;
  uint from = begin_of_bin(begin + lane * each, begin, end), to = begin_of_bin(begin + (lane + 1u) * each, begin, end);
  barrier();
  uint gap = 1u;
  while (gap < most / k_insertion) gap = 3u * gap + 1u;
  do {
    insert(from, to, gap);
    gap /= 3u;
  } while (gap > 0u);
}

void main() {
  uint lane = gl_LocalInvocationID.x, tile = tile_of_group();
  uint begin = min(offsets[tile], push.capacity), end = min(offsets[tile + 1u], push.capacity);
  if (begin == end) return;
  vec2 range = depth_range(lane, begin, end);
  if (lane == 0u) depth_ranges[tile] = range;
  uint wanted = push.slices > 0u ? push.slices : end - begin, odd = k_bins_of_lane & 1u;
  uint bins_of_lane = min((wanted + k_lanes - 1u) / k_lanes | odd, k_bins_of_lane);
  uint count = k_lanes * bins_of_lane;
  used_bins = push.slices > 0u ? push.slices : count;
  nearest = range.x;
  bins_per_depth = range.x > range.y ? float(used_bins) * 0.99999 / (range.x - range.y) : 0.0;
  for (uint k = lane; k < count; k += k_lanes) bins[k] = 0u;
  barrier();
  for (uint k = begin + lane; k < end; k += k_lanes) atomicAdd(bins[bin_of(depth_of(k))], 1u);
  barrier();
  uint most = add_up(lane, begin, bins_of_lane);
  for (uint k = begin + lane; k < end; k += k_lanes) {
    uint place = atomicAdd(bins[bin_of(depth_of(k))], 1u);
    ordered[place] = uvec2(texelFetch(entries, int(2u * k)).r, texelFetch(entries, int(2u * k + 1u)).r);
  }
  memoryBarrierBuffer();
  barrier();
  sort(lane, begin, end, most);
}
