#pragma once
// What stands below the procedural head in pictures.
#include "strands/mesh.h"

namespace cuticle::strands {

/// Adds neck and shoulders below the procedural head, open below; texture coordinates are dropped.
void add_shoulders(Mesh& head);

}  // namespace cuticle::strands
