#version 460
#extension GL_GOOGLE_include_directive : require
#define MAPS_BINDING 0
#include "render/passes/surface_shadow/surface_maps.glsl"
layout(location = 0) flat in uint light;

void main() {
  if (!in_own_map(gl_FragCoord.xy, light)) discard;
}
