// The invocations of a tile, a subgroup, read each segment for themselves, from what tiles_prepare.comp left: on lavapipe
// a broadcast is a search for the lane, and eight loads from one place take as long as from eight. So each draws its own
// list: the segments of the tile that may cover its block.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#include "render/passes/tiles/prepared.glsl"
#include "render/passes/tiles/projected_segment.glsl"

layout(binding = 0) uniform usamplerBuffer records;

ProjectedSegment segment_from_vertex(uint vertex) {
  int first = int(k_record_texels * record_place(vertex));
  return recorded_segment(texelFetch(records, first), texelFetch(records, first + 1), texelFetch(records, first + 2));
}

uint own_lane() { return gl_SubgroupInvocationID; }

const int k_unrolled = 2;  // segments, of which a pixel may so have 100,000 and more
const uint k_chunk = 32u, k_entries_each = k_chunk / k_lanes;
const float k_margin = 0.02;  // pixels, more than rounding takes

shared float values[k_lanes];
shared uint blocks_of_four[k_lanes];  // of 4 segments of the chunk each: which blocks they may cover, 8 bits for each

// Bit b: the segment may cover pixels of block b of a tile.
uint covered_blocks(ProjectedSegment own, vec2 tile_corner) {
  vec2 along = own.axis.xy, block = vec2(block_size()), size = 0.5 * block, start = tile_corner + 0.5 * block;
  float widest = own.half_width + abs(own.width_slope) * own.half_length;
  vec2 reach = vec2(widest, own.half_length + cap_of(widest));
  reach += vec2(dot(abs(along.yx), size), dot(abs(along), size)) + k_margin;
  float d = along.x * start.y - along.y * start.x + own.axis.z, s = dot(along, start) + own.axis.w;
  uint blocks = 0u;
  [[unroll]] for (uint b = 0u; b < k_lanes; ++b) {
    vec2 from_start = vec2(first_of_block(b));
    bool covers = abs(d + along.x * from_start.y - along.y * from_start.x) < reach.x &&
                  abs(s + dot(along, from_start)) < reach.y;
    blocks |= covers ? 1u << b : 0u;
  }
  return blocks;
}

// Bit k: segment first + k may cover the invocation's own block.
uint own_segments(uint first, uint end, vec2 tile_corner) {
  uint lane = own_lane(), told = 0u, own = 0u;
  [[unroll]] for (uint k = 0u; k < k_entries_each; ++k) {
    uint entry = first + k_entries_each * lane + k;
    uint blocks = covered_blocks(segment_from_vertex(vertex_of(min(entry, end - 1u))), tile_corner);
    told |= entry < end ? blocks << (8u * k) : 0u;
  }
  blocks_of_four[lane] = told;
  subgroupBarrier();
  [[unroll]] for (uint k = 0u; k < k_lanes; ++k)
    own |= (((blocks_of_four[k] >> lane & 0x01010101u) * 0x01020408u) >> 24) << (k_entries_each * k);
  subgroupBarrier();
  return own;
}

// Each invocation draws those that may cover its own block.
void draw_chunk(uint first, uint end, vec2 first_pixel, vec2 tile_corner) {
  uint left = own_segments(first, end, tile_corner);
  do {
    [[unroll]] for (int k = 0; k < k_unrolled; ++k) {
      if (left != 0u) draw(set_up(first + uint(findLSB(left)), end, tile_corner + 0.5 * float(k_tile)), first_pixel);
      left &= left - 1u;
    }
  } while (left != 0u);
}

bool is_below_in_all(float own, float limit) { return subgroupAll(own < limit); }

// In one order, so that all find the same.
float sum_in_all(float own) {
  values[own_lane()] = own;
  subgroupBarrier();
  float sum = values[0];
  [[unroll]] for (uint k = 1u; k < k_lanes; ++k) sum += values[k];
  subgroupBarrier();
  return sum;
}
