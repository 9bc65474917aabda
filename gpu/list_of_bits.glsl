// One workgroup of 256: a list of the bits that are set, in their order, and the workgroups that walk such a list. The
// shader that includes this defines BITS(word) and LISTED(place).
shared uint sums[256];

/// Writes the numbers of the set bits; in the last invocation gives how many there are. Every invocation has a run of words.
uint list_bits(uint bit_count) {
  const uint lane = gl_LocalInvocationID.x, words = (bit_count + 31u) / 32u, run = (words + 255u) / 256u;
  const uint begin = min(lane * run, words), end = min(begin + run, words);
  uint sum = 0u;
  for (uint word = begin; word < end; ++word) sum += bitCount(BITS(word));
  sums[lane] = sum;
  barrier();
  uint next = 0u;
  for (uint k = 0u; k < lane; ++k) next += sums[k];
  for (uint word = begin; word < end; ++word)
    for (uint left = BITS(word); left != 0u; left &= left - 1u) LISTED(next++) = 32u * word + uint(findLSB(left));
  return next;
}

/// groups_for of gpu/groups.h.
uvec3 groups_for(uint threads) {
  const uint k_row = 32768u, groups = (threads + 63u) / 64u;
  return groups <= k_row ? uvec3(groups, 1u, 1u) : uvec3(k_row, (groups + k_row - 1u) / k_row, 1u);
}
