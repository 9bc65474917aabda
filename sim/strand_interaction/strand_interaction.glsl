// What both kernels share: the frame's constants and where a vertex is in the grid. One thread a vertex. With ON_SKIN,
// whose buffers are bound from k_skin_binding on, every strand has a head of its own.
#include "gpu/groups.glsl"
#include "sim/strand_interaction/strand_grid.glslh"
layout(local_size_x = 64) in;

layout(push_constant) uniform Constants {
  GridFrame grid;
  uvec3 nodes;
  uint vertex_count, component_stride, before_offset;  // of the state's velocities, see strand_interaction_gpu.h
};
const uint k_words = 8u;  // of a node: three momenta and the mass, low word first

#ifdef ON_SKIN
#include "sim/chains/skin/skin_strand.glsl"
layout(binding = k_skin_binding) readonly buffer SkinStrands { SkinStrand skin_strands[]; };
layout(binding = k_skin_binding + 1) readonly buffer SkinEnd { vec4 skin_end[]; };
layout(binding = k_skin_binding + 2) readonly buffer StrandOfVertex { uint strand_of_vertex[]; };

GridFrame frame_of(uint vertex) {
  SkinStrand s = skin_strands[strand_of_vertex[vertex]];
  vec3 anchor = skin_end[s.vertices.x].xyz;
  SkinTurn turn = turn_of(s, anchor, skin_end[s.vertices.y].xyz, skin_end[s.vertices.z].xyz);
  GridFrame frame = grid;
  frame.turn_x = turn.x;
  frame.turn_y = turn.y;
  frame.turn_z = turn.z;
  frame.translation = anchor - (turn.x * s.root.x + turn.y * s.root.y + turn.z * s.root.z);
  return frame;
}
#else
GridFrame frame_of(uint vertex) { return grid; }
#endif

struct Spot {
  uvec3 cell, fine;
  bool inside;
};
Spot spot_of(GridFrame frame, vec3 world_place) {
  vec3 place = fine_place(frame, head_place(frame, world_place));
  bool inside = all(greaterThanEqual(place, vec3(0))) && all(lessThan(place, vec3((nodes - 1u) * 32u)));
  uvec3 whole = uvec3(inside ? place : vec3(0));
  return Spot(whole / 32u, whole % 32u, inside);
}
uint node_at(Spot spot, uint k) {
  uvec3 at = spot.cell + uvec3(k & 1u, k >> 1 & 1u, k >> 2 & 1u);
  return (at.y * nodes.z + at.z) * nodes.x + at.x;
}
ivec3 counted(vec3 velocity) {
  return ivec3(counted_speed(velocity.x), counted_speed(velocity.y), counted_speed(velocity.z));
}
