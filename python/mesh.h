#pragma once
// Meshes from arrays and to arrays.
#include "strands/mesh.h"

#include "python/arrays.h"

namespace cuticle::python {

/// Vertices in metres and three of them a triangle, with normals. Error: bad_input, naming the triangle whose corner is
/// no vertex.
strands::Mesh mesh_of(const Floats& positions, const Indices& triangles);
/// (positions, triangles, normals)
nb::tuple arrays_of(const strands::Mesh& mesh);

}  // namespace cuticle::python
