#version 460
#extension GL_GOOGLE_include_directive : require
// Surfaces as the lights see them, an instance per light.
#define MAPS_BINDING 0
#include "render/passes/surface_shadow/surface_maps.glsl"
layout(std430, set = 0, binding = 1) readonly buffer Positions { vec4 positions[]; };
layout(std430, set = 0, binding = 2) readonly buffer Indices { uint indices[]; };
layout(push_constant) uniform Push { mat4 rest_to_world; };
layout(location = 0) flat out uint light;

void main() {
  light = uint(gl_InstanceIndex);
  gl_Position = map_clip(light, (rest_to_world * vec4(positions[indices[gl_VertexIndex]].xyz, 1.0)).xyz);
}
