// A workgroup per tile, each invocation some of its pixels, on which it draws segments in the order of the tile's list.
// Loops over few are unrolled: the loops of an invocation may make 65,535 turns together on lavapipe, after
// which it leaves them. The shader that includes this defines depth_culled(), take() and end_segment(), and includes exchange_shared.glsl
// or exchange_records.glsl, and areas.glsl or spans.glsl.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "render/passes/tile_lists/tile_of_group.glsl"
#include "render/passes/tiles/projected_segment.glsl"
#include "render/passes/tiles/part_colors.glsl"
#include "render/visibility/seen.glsl"

layout(constant_id = 0) const uint k_says_seen = 0u;  // 1: `seen` is wanted

layout(std430, binding = 2) readonly buffer Offsets { uint offsets[]; };
layout(binding = 3) uniform usamplerBuffer ordered;  // uvec2 an entry
layout(std430, binding = 4) readonly buffer SceneDepth { float scene_depth[]; };
layout(std430, binding = 5) writeonly buffer Picture { uvec2 picture[]; };  // radiance times alpha, alpha
layout(std430, binding = 6) writeonly buffer Depth { float mean_depth[]; };  // 1 / distance, weighted by what is seen
layout(std430, binding = 7) writeonly buffer SeenSegments { Seen seen[]; };

const float k_opaque = 1.0 / 1024.0;  // what lies behind so little transmittance is left out

// Of the block's pixels: what is let transmittance, the scene's depth, what has been blended.
float transmittance[k_block], scene[k_block], depth[k_block], most_seen[k_block];
vec3 light[k_block];
uint seen_vertex[k_block], samples[k_block], looked_at;

// Whether a segment whose 1 / depth in the tile lies between the two is left out of what is being drawn.
bool depth_culled(float least, float most);

// The part of a segment that begins at a vertex covers a share of a pixel of the block, in front of the scene.
void take(int k, uint vertex, float covered, vec3 color, float inverse_depth);
void end_segment();  // it has been drawn on all pixels of the block

uint vertex_of(uint entry) { return texelFetch(ordered, int(2u * entry + 1u)).r; }

Prepared set_up(uint entry, uint end, vec2 tile_middle) {
  bool used = entry < end;
  uint vertex = vertex_of(min(entry, end - 1u));
  ProjectedSegment own = segment_from_vertex(vertex);
  float half_length = own.half_length, len = 2.0 * half_length, reach = 0.7072 * float(k_tile);
  float s = dot(tile_middle, own.axis.xy) + own.axis.w;
  vec2 ends = own.inverse_depth + own.depth_slope * clamp(vec2(s - reach, s + reach), -half_length, half_length);
  used = used && !depth_culled(min(ends.x, ends.y), max(ends.x, ends.y));
  float per_pixel = len > k_shortest ? 1.0 / len : 0.0;
  vec3 shade[2] = vec3[2](0.5 * (own.first + own.last), (own.last - own.first) * per_pixel);
  if (k_parts > 1u) shade = parts_of(own, per_pixel);
  return Prepared(own.axis,
                  vec4(own.half_width, used ? push.opacity : 0.0, half_length, own.width_slope),
                  vec4(shade[0], own.inverse_depth), vec4(shade[1], own.depth_slope), vertex);
}

// The first pixel of a tile of the part that is drawn.
uvec2 corner_of(uint tile) { return uvec2(tile % tile_grid().x, tile / tile_grid().x) * uint(k_tile); }

// The first pixel of an invocation's block.
uvec2 block_of(uint lane, uvec2 corner) { return corner + first_of_block(lane / k_sharers); }

void begin_block(uvec2 block) {
  looked_at = 0u;
  [[unroll]] for (int k = 0; k < k_block; ++k) {
    uvec2 at = min(block + in_block(k), push.part - 1u);
    transmittance[k] = 1.0;
    depth[k] = most_seen[k] = 0.0;
    scene[k] = scene_depth[at.y * push.part.x + at.x];
    light[k] = vec3(0.0);
    seen_vertex[k] = samples[k] = 0u;
  }
}

float most_through() {
  float most = 0.0;
  [[unroll]] for (int k = 0; k < k_block; ++k) most = max(most, transmittance[k]);
  return most;
}

// Whether every pixel of the tile lets through too little for what lies behind to be seen.
bool is_closed() { return is_below_in_all(most_through(), k_opaque); }

void end_block(uvec2 block) {
  [[unroll]] for (int k = 0; k < k_block; ++k) {
    uvec2 at = block + in_block(k);
    if (at.x < push.part.x && at.y < push.part.y) {
      uint pixel = at.y * push.part.x + at.x;
      float alpha = 1.0 - transmittance[k];
      picture[pixel] = uvec2(packHalf2x16(light[k].rg), packHalf2x16(vec2(light[k].b, alpha)));
      mean_depth[pixel] = alpha > 0.0 ? depth[k] / alpha : 0.0;
      uint first = seen_vertex[k], last = samples[k] > 0u ? first + 1u : first;
      if (k_says_seen != 0u) seen[pixel] = Seen(first, last, alpha, samples[k], looked_at);
    }
  }
}
