// What a pixel sees of a visibility buffer: the strand that most of its samples see, how many see any, how many strands
// they see.
#extension GL_GOOGLE_include_directive : require
#include "render/passes/aovs/aovs.glsl"
#include "render/visibility/segment_ends.glsl"

layout(constant_id = 0) const int k_samples = 1;        // of a texel
layout(constant_id = 5) const int k_supersampling = 1;  // texels across a pixel
const int k_all = k_samples * k_supersampling * k_supersampling;

/// The segment that a sample sees, from 1; 0: none.
uint segment_at(ivec2 texel, int sample_index);

ivec2 texel_of(uint pixel, int k) {
  const int texel = k / k_samples;
  return ivec2(pixel % resolution.x, pixel / resolution.x) * k_supersampling +
         ivec2(texel % k_supersampling, texel / k_supersampling);
}

// How many samples see the strand of sample k; 0 where an earlier one saw it, or none does.
int count_of(uint seen_by[k_all], int k) {
  int count = 0;
  for (int j = 0; j < k_all && seen_by[k] > 0u; ++j) {
    bool same = seen_by[j] > 0u && (seen_by[j] - 1u) / drawn_segments == (seen_by[k] - 1u) / drawn_segments;
    if (same && j < k) return 0;
    count += same ? 1 : 0;
  }
  return count;
}

Seen seen_in(uint pixel) {
  uint seen_by[k_all];
  for (int k = 0; k < k_all; ++k) seen_by[k] = segment_at(texel_of(pixel, k), k % k_samples);
  Seen result = Seen(0u, 0u, 0.0, 0u, 0u);
  int most = 0;
  for (int k = 0; k < k_all; ++k) {
    int count = count_of(seen_by, k);
    result.coverage += float(count) / float(k_all);
    result.samples += count > 0 ? 1u : 0u;
    if (count <= most) continue;
    most = count;
    uint segment = seen_by[k] - 1u, strand = segment / drawn_segments, begin = segment % drawn_segments;
    result.first = vertex_of(strand, begin);
    result.last = vertex_of(strand, begin + 1u);
  }
  result.cost = result.samples;
  return result;
}
