#pragma once
// A mesh in smaller triangles.
#include "strands/mesh.h"

namespace cuticle::strands {

/// The same surface in more triangles: edges longer than `longest_edge` (metres, above 0) are halved, in all triangles
/// that share them, until none is left. The vertices of `mesh` come first; uv are linear; normals are made anew.
Mesh refined(const Mesh& mesh, double longest_edge);

}  // namespace cuticle::strands
