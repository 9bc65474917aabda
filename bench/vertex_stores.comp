#version 460
#extension GL_GOOGLE_include_directive : require
// What interpolate.comp writes and nothing else: one thread per drawn strand, two vec4 for each of its vertices. The
// least that a frame which leaves positions and tangents in buffers can cost on a device.
#include "gpu/groups.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 1) writeonly buffer Tangents { vec4 tangents[]; };
layout(push_constant) uniform Constants { uint strands; uint count; };

void main() {
  const uint strand = invocation();
  if (strand >= strands) return;
  for (uint i = strand * count; i < (strand + 1u) * count; ++i) {
    vertices[i] = vec4(i);
    tangents[i] = vec4(strand);
  }
}
