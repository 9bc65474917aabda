#version 460
#extension GL_GOOGLE_include_directive : require
// From the sums at its nodes what a vertex's velocity gains, in the solver's state and in what it hands over.
const int k_skin_binding = 7;
#include "sim/strand_interaction/strand_interaction.glsl"
layout(binding = 0) readonly buffer World { vec4 world[]; };
layout(binding = 1) buffer Velocities { vec4 velocities[]; };
layout(binding = 2) readonly buffer Masses { uint masses[]; };
layout(binding = 3) readonly buffer Sums { uint sums[]; };
layout(binding = 4) readonly buffer RestDensities { float rest_densities[]; };
layout(binding = 5) readonly buffer Places { uint state_places[]; };  // of a vertex's velocity; all bits: carried
layout(binding = 6) buffer States { float state[]; };

// Negative sums are negated before they become a number: the low word alone rounds to 2^32.
float number_at(uint at) {
  uint low = sums[at], high = sums[at + 1u];
  bool negative = (high & 0x80000000u) != 0u;
  if (negative) {
    low = ~low + 1u;
    high = ~high + uint(low == 0u);
  }
  float size = float(high) * 4294967296.0 + float(low);
  return negative ? -size : size;
}

Found found_of(Spot spot) {
  vec3 share = vec3(spot.fine) * (1.0 / 32);
  Found found = Found(vec3(0), 0, vec3(0));
  for (uint k = 0u; k < 8u; ++k) {
    uint at = node_at(spot, k) * k_words;
    float mass = number_at(at + 6u);
    vec3 mean = vec3(number_at(at), number_at(at + 2u), number_at(at + 4u)) * (1 / max(mass, 1));
    found = found_at(found, k, share, mean, mass);
  }
  return found;
}

void push(uint first, vec3 change) {
  for (uint c = 0u; c < 3u; ++c) state[first + c * component_stride] += change[c];
}

void main() {
  uint i = invocation();
  if (i >= vertex_count || masses[i] == 0u || state_places[i] == 0xffffffffu) return;
  GridFrame frame = frame_of(i);
  Spot spot = spot_of(frame, world[i].xyz);
  if (!spot.inside) return;
  vec3 velocity = velocities[i].xyz;
  vec3 change = velocity_change(frame, found_of(spot), vec3(counted(velocity)), rest_densities[i]);
  push(state_places[i], change);
  if (before_offset != 0u) push(state_places[i] + before_offset, change);
  velocities[i].xyz = velocity + change;
}
