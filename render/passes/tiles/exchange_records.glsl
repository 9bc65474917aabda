// The invocations of a tile, a subgroup, read each segment for themselves, all the same one, from what tiles_prepare.comp
// left: a broadcast is a search for the lane on lavapipe, which takes longer than reading 16 numbers.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#include "cuticle/render/passes/tiles/prepared.glsl"
#include "cuticle/render/passes/tiles/stroke.glsl"

layout(binding = 0) uniform usamplerBuffer records;

Stroke stroke_from(uint vertex) {
  int first = int(k_record_texels * vertex);
  return recorded_stroke(texelFetch(records, first), texelFetch(records, first + 1), texelFetch(records, first + 2));
}

uint own_lane() { return gl_SubgroupInvocationID; }

bool is_damaged = false;  // never: it holds the compiler to the loads

// Brings the eight segments near at once, in place of one after the other.
void begin_eight(uint first, uint end, vec2 tile_middle) {
  int texel = int(k_record_texels * vertex_of(min(first + own_lane(), end - 1u)));
  uint bits = texelFetch(records, texel).x & texelFetch(records, texel + 2).w;
  is_damaged = is_damaged || bits == 0xffffffffu;
}

Prepared prepared(uint k, uint first, uint end, vec2 tile_middle) { return set_up(first + k, end, tile_middle); }

bool is_below_in_all(float own, float limit) { return subgroupAll(own < limit || is_damaged); }
