#version 460
#extension GL_GOOGLE_include_directive : require
#include "sim/control/control.glslh"
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer Simulated { vec4 simulated[]; };
layout(binding = 1) readonly buffer Authored { vec4 authored[]; };  // w: its weight
layout(binding = 2) writeonly buffer World { vec4 world[]; };
layout(binding = 3) readonly buffer SimulatedVelocities { vec4 simulated_velocities[]; };
layout(binding = 4) readonly buffer AuthoredVelocities { vec4 authored_velocities[]; };  // w: rate of the weight, 1/s
layout(binding = 5) writeonly buffer Velocities { vec4 velocities[]; };
layout(push_constant) uniform Constants { uint vertex_count; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= vertex_count) return;
  vec4 own = simulated[i], other = authored[i], speed = authored_velocities[i];
  world[i] = vec4(blended(own.xyz, other.xyz, other.w), 1);
  velocities[i] = vec4(blended_velocity(simulated_velocities[i].xyz, speed.xyz, other.xyz - own.xyz, other.w, speed.w), 0);
}
