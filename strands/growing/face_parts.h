#pragma once
// Ears, closed eyelids and lips as sheets over a grid; ears and lids for the side of +x.
#include "strands/mesh.h"

namespace cuticle::strands {

/// An ear with its rim, fold, hollow and lobe: 65 mm high, standing 15 mm off the head. No normals.
Mesh make_ear();
/// Lids over an eyeball, closed, with a crease above and lashes along the seam. No normals.
Mesh make_eyelids();

/// Closed lips, on both sides of x = 0. No normals.
Mesh make_lips();

}  // namespace cuticle::strands
