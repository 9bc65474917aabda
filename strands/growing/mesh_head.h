#pragma once
// A scanned or modelled head in place of the procedural one.
#include "strands/growing/growing.h"

namespace cuticle::strands {

/// The head of a mesh: y up, facing +z, in metres but for a factor of 0.5 to 2, with its crown (neck and shoulders may
/// follow). It is scaled and moved until its skull lies on that of `make_head`, so that grooming specifications,
/// cameras and lights mean the same on both. The scalp has about `scalp_vertices` vertices, in the directions of the
/// procedural one's; each collider is the largest sphere about the place of the procedural one's that lies within the
/// mesh. Error: bad_input where the mesh has no normals, or its skull is more than 1 cm off (rms) the procedural one.
Result<Head> head_of_mesh(Mesh mesh, int scalp_vertices = 300);

}  // namespace cuticle::strands
