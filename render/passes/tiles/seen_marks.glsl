// The fine rasteriser without its picture: marks the segments of which some pixel sees something
// (render/passes/seen_vertices).
layout(std430, binding = 8) writeonly buffer Marks { uint marks[]; };  // per vertex, of the part that begins there

// Parts of the segment being drawn that show on the invocation's pixels.
uint first_shown = 0xffffffffu, last_shown = 0u;

void take(int k, uint vertex, float covered, vec3 color, float inverse_depth) {
  float weight = seen_share(transmittance[k], covered);
  transmittance[k] -= weight;
  if (weight <= 0.0) return;
  first_shown = min(first_shown, vertex);
  last_shown = max(last_shown, vertex);
}

void end_segment() {
  const uint parts = first_shown <= last_shown ? last_shown - first_shown + 1u : 0u;
  [[unroll]] for (uint k = 0u; k < k_parts; ++k)
    if (k < parts) marks[first_shown + k] = 1u;
  first_shown = 0xffffffffu;
  last_shown = 0u;
}

void end_picture(uvec2 block) {}
