#pragma once
// What the procedural head is drawn with in pictures, and hair does not collide with.
#include "strands/mesh.h"

namespace cuticle::strands {

/// Adds a neck and shoulders, open below, ears with their folds, closed eyelids and lips to the procedural head; texture
/// coordinates are dropped.
void add_bust(Mesh& head);

}  // namespace cuticle::strands
