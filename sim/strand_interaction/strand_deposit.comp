#version 460
#extension GL_GOOGLE_include_directive : require
// What every vertex counts at its eight nodes. Sums of 64 bits as two words: the low word's wraps are carried, and
// their number does not depend on the order.
const int k_skin_binding = 4;
#include "sim/strand_interaction/strand_interaction.glsl"
layout(binding = 0) readonly buffer World { vec4 world[]; };
layout(binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(binding = 2) readonly buffer Masses { uint masses[]; };
layout(binding = 3) buffer Sums { uint sums[]; };

void add(uint at, int high, uint low) {
  uint before = atomicAdd(sums[at], low);
  uint carried = uint(high) + uint(before + low < before);
  if (carried != 0u) atomicAdd(sums[at + 1u], carried);
}

void count(uint node, int mass, ivec3 speed) {
  for (uint c = 0u; c < 3u; ++c) {
    int high, low;
    imulExtended(mass, speed[c], high, low);
    if (low != 0 || high != 0) add(node * k_words + 2u * c, high, uint(low));
  }
  add(node * k_words + 6u, 0, uint(mass));
}

void main() {
  uint i = invocation();
  if (i >= vertex_count || masses[i] == 0u) return;
  Spot spot = spot_of(frame_of(i), world[i].xyz);
  vec3 velocity = velocities[i].xyz;
  if (!spot.inside || any(greaterThan(abs(velocity), vec3(128))))
    atomicAdd(sums[nodes.x * nodes.y * nodes.z * k_words], 1u);
  if (!spot.inside) return;
  ivec3 speed = counted(velocity);
  for (uint k = 0u; k < 8u; ++k) {
    uint weight = node_weight(k, spot.fine.x, spot.fine.y, spot.fine.z);
    if (weight != 0u) count(node_at(spot, k), int(weight * masses[i]), speed);
  }
}
