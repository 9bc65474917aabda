// What of a light arrives at a vertex, per channel: light by light `transmittance` holds a float per vertex for each
// different opacity, read as texels (strands/spline/drawn.glsl). Before this stand TRANSMITTANCE_BINDING, vertex_count
// and CHANNEL_CONSTANT.
#include "render/channels.glsl"

layout(set = 0, binding = TRANSMITTANCE_BINDING) uniform samplerBuffer gathered_transmittance;
float transmittance_at(uint place) { return texelFetch(gathered_transmittance, int(place)).r; }

vec3 transmitted(uint light, uint vertex) {
  const uint first = light * k_different * vertex_count + vertex;
  if (k_different == 1u) return vec3(transmittance_at(first));
  return vec3(transmittance_at(first + k_of_red * vertex_count), transmittance_at(first + k_of_green * vertex_count),
              transmittance_at(first + k_of_blue * vertex_count));
}
