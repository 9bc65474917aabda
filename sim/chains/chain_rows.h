#pragma once
// The arrays of a block of strands that have equally many links. Included by units for one instruction set that no
// symbol may leave, so it holds types only.
#include "sim/chains/contact/moving_contact.glslh"
#include "sim/chains/rows.glslh"

namespace cuticle::sim::chains {

/// As strand_row::guarded: the lane was put back; it starts anew with the first order too.
constexpr int k_was_reset = 2;

/// Vertex 0 is the anchor; one more than there are vertices ends the arrays.
template <class Real>
struct ChainBlock {
  int links;
  const Real* rest;
  Real *state, *strand;
  Real* scratch;     ///< (links + 2) * scratch_rows * k_lanes
  int scratch_rows;  ///< of a vertex: scratch_row::count, or more
  Real* own;         ///< rows of a vertex that a solver adds; null without
};

/// Rows of a moment between two substeps on a skin: columns of a strand's rotation, how far its root moved to be there,
/// and where in the world that is.
namespace turn_row {
constexpr int x = 0, y = 3, z = 6, step = 9, root = 12, count = 15;
}

/// Rows of a collider beside a strand: LinkSphere of its own (a box', a field's grid's); the radius around the whole,
/// and its centre at the substep's begin.
namespace collider_row {
constexpr int centre = 0, radius = 3, around = 4, begin = 5, count = 8;
}

/// The substeps of a frame and the colliders within reach, in rest space; `collider_rows`: collider_row::count *
/// k_lanes for each. With `carries`, for boxes and fields that move by themselves: boxes and fields of one substep
/// after the other, at its end, in the world's axes, relative to the head's translation (on a skin in the world), and
/// what a substep's boxes, then its fields carry along; 3 * k_lanes more rows for each of these.
template <class Real>
struct ChainFrame {
  const ChainStep<Real>* steps;
  int count;
  const LinkSphere<Real>* spheres;
  int sphere_count;
  const LinkBox<Real>* boxes;
  int box_count;
  Real* collider_rows;
  const LinkField<Real>* fields = nullptr;
  int field_count = 0;
  const float* const* field_values = nullptr;  ///< of each field
  const ColliderCarry<Real>* carries = nullptr;
  const Real* turns = nullptr;  ///< on a skin: rows of the moments (on_skin.h); null: the head's
};

template <class Real>
using Advance = void (*)(const ChainBlock<Real>&, const ChainFrame<Real>&);

}  // namespace cuticle::sim::chains
