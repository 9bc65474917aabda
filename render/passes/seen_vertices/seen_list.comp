#version 460
#extension GL_GOOGLE_include_directive : require
// One workgroup: the list of the vertices whose bit is set, in their order, and how many workgroups they take (groups_for
// of gpu/groups.h). Every invocation has a run of words.
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Bits { uint bits[]; };
layout(std430, binding = 1) writeonly buffer List { uint count, groups[3], list[]; };
layout(push_constant) uniform Push { uint vertex_count; };

shared uint sums[256];

void main() {
  const uint lane = gl_LocalInvocationID.x, words = (vertex_count + 31u) / 32u, run = (words + 255u) / 256u;
  const uint begin = min(lane * run, words), end = min(begin + run, words);
  uint sum = 0u;
  for (uint word = begin; word < end; ++word) sum += bitCount(bits[word]);
  sums[lane] = sum;
  barrier();
  uint next = 0u;
  for (uint k = 0u; k < lane; ++k) next += sums[k];
  for (uint word = begin; word < end; ++word)
    for (uint left = bits[word]; left != 0u; left &= left - 1u) list[next++] = 32u * word + uint(findLSB(left));
  if (lane < 255u) return;
  count = next;
  const uint k_row = 32768u, wanted = (next + 63u) / 64u;
  groups[0] = min(wanted, k_row);
  groups[1] = wanted <= k_row ? 1u : (wanted + k_row - 1u) / k_row;
  groups[2] = 1u;
}
