// The fine rasteriser without its picture: marks the segments of which some pixel sees something
// (render/passes/seen_vertices).
layout(std430, binding = 8) writeonly buffer Marks { uint marks[]; };  // per vertex, of the segment that begins there

bool shows = false;  // the segment being drawn, on the invocation's pixels

void take(int k, uint vertex, float covered, vec3 color, float inverse_depth) {
  float weight = seen_share(transmittance[k], covered);
  transmittance[k] -= weight;
  shows = shows || weight > 0.0;
}

void end_segment(uint vertex) {
  if (shows) marks[vertex] = 1u;
  shows = false;
}

void end_picture(uvec2 block) {}
