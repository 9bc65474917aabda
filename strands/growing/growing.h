#pragma once
// From a scalp to hair: control hairs planted on the vertices along the normals, combed, then interpolated to drawn
// strands.
#include "core/registry/members.h"
#include "core/result.h"
#include "core/view.h"
#include "strands/groom.h"
#include "strands/growing/grooming.h"
#include "strands/growing/roots.h"
#include "strands/mesh.h"

namespace cuticle::strands {

/// A head: the whole mesh (drawn, collided with), and its scalp region as a mesh of its own whose triangles carry hair.
struct Head {
  Mesh mesh;
  Mesh scalp;
  std::vector<Sphere> colliders;  ///< spheres that approximate the head, for the simulator
};
/// The procedural head: about 0.23 m tall, facing +z, y up, neck joint at the origin, scalp of `scalp_vertices` about.
Head make_head(int scalp_vertices = 300);

/// How control hairs grow; units and ranges are those of its description.
struct Style {
  int vertices = 7;
  double length = 0.27, variation = 0.12, growth = 1.25, parting = 0.8, comb = 1, droop = 1, cut_height = -2;
  double volume = 0.012, under = 0, fringe = 1, clump = 0.25, radius = 3.5e-5;
  std::uint64_t seed = 1;
};
void describe(registry::Members& members, Style& style);

/// N1, N6: one control hair per scalp vertex, along its normal, segment lengths growing away from the head, then combed
/// and kept outside the head's colliders. `grooming` adds regions, comb strokes and a bun. Error: bad_input where the
/// head lacks vertices or normals.
Result<Groom> plant_control_hairs(const Head& head, const Style& style, const Grooming& grooming = {});

}  // namespace cuticle::strands
