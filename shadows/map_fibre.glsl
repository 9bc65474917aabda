// Sums of the mean fibre (fibres.glslh), which the shader that includes this adds to `fibre_weights` and
// `fibre_coverages`, once for all strips.
#include "shadows/fibres.glslh"

void count_fibre(uint s) {
  if (strip_number() != 0u || !is_sampled(s)) return;
  const MapSegment segment = map_segment(s);
  const uint weight = piece_weight(segment_footprint(segment.a, segment.b, segment.half_width, 0.0, 0.0).size);
  atomicAdd(fibre_weights, weight);
  atomicAdd(fibre_coverages, weight * middle_coverage(segment.half_width));
}
