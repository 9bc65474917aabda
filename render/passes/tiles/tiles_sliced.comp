#version 460
#extension GL_GOOGLE_include_directive : require
// Fine rasteriser by slices: each fragment goes to the slice of the tile's depth range that its own depth lies in.
// Those of one slice and pixel are blended in the order of the tile's list as they come, which is what blending a list
// of them afterwards gives; then the slices, from near to far. As many slices at a time as shared memory has room for.
#include "render/passes/tiles/exchange_shared.glsl"
#include "render/passes/tiles/areas.glsl"

layout(std430, binding = 8) readonly buffer DepthRanges { vec2 depth_ranges[]; };  // greatest and least 1 / depth

const uint k_at_once = k_draws_lists ? 8u : 16u, k_places = k_at_once * uint(k_block) * k_lanes;
shared vec4 slice_light[k_places];  // what it lets through in w
shared float slice_depth[k_places];
shared vec2 slice_seen[k_says_seen * (k_places - 1u) + 1u];  // greatest share of the slice, bits of its vertex

uint first_slice;
float nearest, slices_per_depth;

// Fragments nearer or farther than where any segment passes the tile's middle go to the first or the last slice.
uint slice_of(float inverse_depth) {
  return uint(clamp((nearest - inverse_depth) * slices_per_depth, 0.0, float(push.slices - 1u)));
}

uint place_of(uint slice, int k) { return (slice * uint(k_block) + uint(k)) * k_lanes + own_lane(); }

bool depth_culled(float least, float most) {
  return slice_of(most) >= first_slice + k_at_once || slice_of(least) < first_slice;
}

void take(int k, uint vertex, float covered, vec3 color, float inverse_depth) {
  uint slice = slice_of(inverse_depth) - first_slice;  // wraps to a large number below the first
  if (covered <= 0.0 || slice >= k_at_once) return;
  uint place = place_of(slice, k);
  vec4 own = slice_light[place];
  float weight = own.w * covered;
  slice_light[place] = own + weight * vec4(color, -1.0);
  slice_depth[place] += weight * inverse_depth;
  if (k_says_seen == 0u) return;
  samples[k] += 1u;
  if (weight > slice_seen[place].x) slice_seen[place] = vec2(weight, uintBitsToFloat(vertex));
}

void end_segment() {}

void empty_slices() {
  for (uint slice = 0u; slice < k_at_once; ++slice)
    for (int k = 0; k < k_block; ++k) {
      uint place = place_of(slice, k);
      slice_light[place] = vec4(0.0, 0.0, 0.0, 1.0);
      slice_depth[place] = 0.0;
      if (k_says_seen != 0u) slice_seen[place] = vec2(0.0);
    }
}

void blend_slices() {
  for (uint slice = 0u; slice < k_at_once; ++slice)
    [[unroll]] for (int k = 0; k < k_block; ++k) {
      uint place = place_of(slice, k);
      vec4 own = slice_light[place];
      light[k] += transmittance[k] * own.rgb;
      depth[k] += transmittance[k] * slice_depth[place];
      if (k_says_seen != 0u && transmittance[k] * slice_seen[place].x > most_seen[k]) {
        most_seen[k] = transmittance[k] * slice_seen[place].x;
        seen_vertex[k] = floatBitsToUint(slice_seen[place].y);
      }
      transmittance[k] *= own.w;
    }
}

void main() {
  uint tile = tile_of_group();
  uint begin = min(offsets[tile], push.capacity), end = min(offsets[tile + 1u], push.capacity);
  if (begin == end) return;  // the picture was emptied
  uvec2 corner = corner_of(tile), block = block_of(own_lane(), corner);
  begin_block(block);
  vec2 range = depth_ranges[tile];
  nearest = range.x;
  slices_per_depth = range.x > range.y ? float(push.slices) * 0.99999 / (range.x - range.y) : 0.0;
  for (first_slice = 0u; first_slice < push.slices; first_slice += k_at_once) {
    empty_slices();
    for (uint first = begin; first < end; first += k_chunk) {
      draw_chunk(first, end, vec2(block + first_pixel()) + 0.5, vec2(corner + first_pixel()));
      barrier();
    }
    looked_at += end - begin;
    blend_slices();
    if (is_closed()) break;
  }
  end_block(block);
}
