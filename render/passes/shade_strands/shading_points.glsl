// Shading points of a strand: some of its vertices, evenly spaced, both ends among them. Before this stand the strand's
// vertices and vertices_per_strand.

/// Point p of n of a strand, as a vertex of it.
uint vertex_of_point(uint p, uint n) { return p * (vertices_per_strand - 1u) / (n - 1u); }

/// The last point that does not come after a vertex; of two that share it the later.
uint point_before(uint vertex, uint n) {
  uint p = vertex * (n - 1u) / (vertices_per_strand - 1u);
  return p + 1u < n && vertex_of_point(p + 1u, n) <= vertex ? p + 1u : p;
}
