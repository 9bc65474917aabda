#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the transmittance of another opacity, or a part of that of the same.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "shadows/channels.glslh"

layout(std430, binding = 0) readonly buffer Root { float root[]; };  // may be the other one
layout(std430, binding = 1) writeonly buffer Other { float other[]; };
layout(push_constant) uniform Push {
  uint vertex_count;
  float ratio;   // of the other opacity to the root's
  float factor;  // what is left of it all
};

void main() {
  const uint v = invocation();
  if (v < vertex_count) other[v] = factor * powered(root[v], ratio);
}
