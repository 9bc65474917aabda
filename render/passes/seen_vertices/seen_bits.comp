#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per 32 vertices: a bit for each that is an end of a segment that is seen.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"

layout(std430, binding = 0) readonly buffer Marks { uint marks[]; };  // per vertex: the segment that begins there is seen
layout(std430, binding = 1) writeonly buffer Bits { uint bits[]; };
layout(push_constant) uniform Push { uint vertex_count; };

void main() {
  const uint word = invocation(), first = 32u * word;
  if (first >= vertex_count) return;
  bool before = first > 0u && marks[first - 1u] != 0u;
  uint own = 0u;
  for (uint k = 0u; k < 32u && first + k < vertex_count; ++k) {
    const bool begins = marks[first + k] != 0u;
    own |= begins || before ? 1u << k : 0u;
    before = begins;
  }
  bits[word] = own;
}
