#version 460
#extension GL_GOOGLE_include_directive : require
#include "cuticle/sim/control/control.glslh"
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer Simulated { vec4 simulated[]; };
layout(binding = 1) readonly buffer Authored { vec4 authored[]; };  // w: its weight
layout(binding = 2) writeonly buffer World { vec4 world[]; };
layout(push_constant) uniform Constants { uint vertex_count; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < vertex_count) world[i] = vec4(blended(simulated[i].xyz, authored[i].xyz, authored[i].w), 1);
}
