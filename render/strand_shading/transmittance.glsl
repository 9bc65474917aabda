// What of a light arrives at a vertex, per channel: light by light `transmittance` holds a float per vertex for each
// different opacity. Before this stand that buffer, vertex_count and CHANNEL_CONSTANT.
#include "render/channels.glsl"

vec3 transmitted(uint light, uint vertex) {
  const uint first = light * k_different * vertex_count + vertex;
  if (k_different == 1u) return vec3(transmittance[first]);
  return vec3(transmittance[first + k_of_red * vertex_count], transmittance[first + k_of_green * vertex_count],
              transmittance[first + k_of_blue * vertex_count]);
}
