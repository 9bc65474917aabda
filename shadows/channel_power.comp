#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the transmittance of another opacity.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "shadows/channels.glslh"

layout(std430, binding = 0) readonly buffer Root { float root[]; };
layout(std430, binding = 1) writeonly buffer Other { float other[]; };
layout(push_constant) uniform Push {
  uint vertex_count;
  float ratio;  // of the other opacity to the root's
};

void main() {
  const uint v = invocation();
  if (v < vertex_count) other[v] = powered(root[v], ratio);
}
