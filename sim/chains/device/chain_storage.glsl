// Buffers of the solvers of rigid links, and the rows of their vertices.
#include "sim/chains/contact/box_contact.glslh"
#include "sim/chains/device/layout.glslh"
#include "sim/chains/rows.glslh"
#include "sim/finite.glsl"
#if ON_SKIN
#include "sim/chains/skin/skin_strand.glsl"
#endif
layout(local_size_x = 64) in;

layout(binding = 0) readonly buffer Places {
  uvec4 places[];
};  // per strand: block, lane, anchor, whether it has links
layout(binding = 1) readonly buffer Blocks { uvec4 blocks[]; };  // links, first vertex
layout(binding = 2) readonly buffer Offsets { uint offsets[]; };
layout(binding = 3) readonly buffer Vertices { uvec4 vertices[]; };  // bits of the rest place; the vertex of the chain
layout(binding = 4) readonly buffer Rest { float rest[]; };          // rows of chain_rows.h
layout(binding = 5) buffer States { float state[]; };
layout(binding = 6) buffer Strands { float strands[]; };
layout(binding = 7) buffer Scratch { float scratch[]; };
layout(binding = 8) readonly buffer Steps { ChainStep steps[]; };
layout(binding = 9) readonly buffer Spheres { LinkSphere spheres[]; };
layout(binding = 10) readonly buffer Frame { FramePlace frame; };
layout(binding = 11) writeonly buffer World { vec4 world[]; };
layout(binding = 12) writeonly buffer Velocities { vec4 velocities[]; };
layout(binding = 13) writeonly buffer Resets { uint resets[]; };
layout(binding = 14) buffer Own { float own[]; };  // rows that the solver adds to a vertex
layout(binding = 15) readonly buffer Reach { uint reach[]; };  // per strand, bits: a collider may touch it; it is woken
#if TOUCHES == 2
layout(constant_id = 1) const bool k_meets_fields = false;
layout(constant_id = 2) const bool k_some_move = false;  // colliders by themselves: ChainFrame::carries
layout(binding = 16) readonly buffer Boxes { LinkBox boxes[]; };
layout(binding = 18) readonly buffer FieldValues { float field_values[]; };  // of one field after the other
#include "sim/chains/contact/moving_contact.glslh"
layout(binding = 17) readonly buffer Fields { LinkField fields[]; };
layout(binding = 19) readonly buffer Carries { ColliderCarry collider_carries[]; };
#else
const bool k_some_move = false;
#endif
#if ON_SKIN
const int k_skin_binding = TOUCHES == 2 ? 20 : 16;
layout(binding = k_skin_binding) readonly buffer SkinStrands { SkinStrand skin_strands[]; };
layout(binding = k_skin_binding + 1) readonly buffer SkinBegin { vec4 skin_begin[]; };  // where the skin has the vertices
layout(binding = k_skin_binding + 2) readonly buffer SkinEnd { vec4 skin_end[]; };      // at the frame's begin and end
#endif
layout(constant_id = 0) const bool k_sleeps = false;

uint first_vertex, lane, strand_base, part;  // of the frame's substeps
uint sphere_count, box_count, field_count;   // colliders that the strand may touch: all, or none
bool is_woken;                               // by what acts on it and did not in the frame before

void find_reach(uint strand) {
  const bool touches = (reach[strand] & 1u) != 0u;
  sphere_count = touches ? all_spheres : 0u;
  box_count = touches ? all_boxes : 0u;
  field_count = touches ? all_fields : 0u;
  is_woken = (reach[strand] & 2u) != 0u;
}

uint rest_at(uint i, uint row) { return ((first_vertex + i) * rest_row_count + row) * k_lanes + lane; }
uint state_at(uint i, uint row) { return ((first_vertex + i) * state_row_count + row) * k_lanes + lane; }
uint scratch_at(uint i, uint row) { return ((first_vertex + i) * k_scratch_rows + row) * k_lanes + lane; }
#define VECTOR_AT(rows, at) vec3(rows[at], rows[(at) + k_lanes], rows[(at) + 2u * k_lanes])
#define PUT_VECTOR(rows, at, v) \
  rows[at] = (v).x;             \
  rows[(at) + k_lanes] = (v).y; \
  rows[(at) + 2u * k_lanes] = (v).z
vec3 state_vector(uint i, uint row) { return VECTOR_AT(state, state_at(i, row)); }
void put_state(uint i, uint row, vec3 v) { PUT_VECTOR(state, state_at(i, row), v); }
vec3 scratch_vector(uint i, uint row) { return VECTOR_AT(scratch, scratch_at(i, row)); }
void put_scratch(uint i, uint row, vec3 v) { PUT_VECTOR(scratch, scratch_at(i, row), v); }
vec3 target_of(uint i) { return VECTOR_AT(rest, rest_at(i, rest_row_target)); }
vec3 anchor_place() { return VECTOR_AT(strands, strand_base); }
ChainVertex chain_vertex(uint i) {
  return ChainVertex(state_vector(i, state_row_here), state_vector(i, state_row_before), state_vector(i, state_row_velocity),
                     state_vector(i, state_row_velocity_before));
}
