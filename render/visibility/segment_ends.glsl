// Segment ends are evenly spaced among the strand's vertices, whatever the level of detail. Before this stand
// vertices_per_strand and drawn_segments.
uint vertex_of(uint strand, uint end) {
  return strand * vertices_per_strand + end * (vertices_per_strand - 1u) / drawn_segments;
}
