#version 460
#extension GL_GOOGLE_include_directive : require
// One workgroup: the strands that are seen, in their order, and what to draw. Every invocation has a run of words.
layout(local_size_x = 256) in;
#include "render/passes/cull_strands/cull_push.glsl"

layout(std430, binding = 0) readonly buffer Seen { uint seen[]; };
layout(std430, binding = 1) writeonly buffer List { uint list[]; };
layout(std430, binding = 2) writeonly buffer Numbers { uint vertices, instances, first_vertex, first_instance; };

shared uint sums[256];

void main() {
  const uint lane = gl_LocalInvocationID.x, words = (strand_count + 31u) / 32u, run = (words + 255u) / 256u;
  const uint begin = min(lane * run, words), end = min(begin + run, words);
  uint sum = 0u;
  for (uint word = begin; word < end; ++word) sum += bitCount(seen[word]);
  sums[lane] = sum;
  barrier();
  uint next = 0u;
  for (uint k = 0u; k < lane; ++k) next += sums[k];
  for (uint word = begin; word < end; ++word)
    for (uint bits = seen[word]; bits != 0u; bits &= bits - 1u) list[next++] = 32u * word + uint(findLSB(bits));
  if (lane < 255u) return;
  vertices = next * drawn_segments * corners;
  instances = 1u;
  first_vertex = first_instance = 0u;
}
