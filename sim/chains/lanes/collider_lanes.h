#pragma once
// Where colliders stand beside every lane of a block, and which vertices are so far from all of them that nothing of
// contacts need be computed, for the units of one instruction set (row_lanes.h).
#include "sim/chains/lanes/row_lanes.h"

namespace cuticle::sim::chains {
namespace {

template <class Scalar>
[[gnu::always_inline]] inline int collider_count(const ChainFrame<Scalar>& frame) {
  return frame.sphere_count + frame.box_count + frame.field_count;
}
/// Of collider k: spheres, then boxes, then fields.
template <class Scalar>
[[gnu::always_inline]] inline Scalar* rows_of_collider(const ChainFrame<Scalar>& frame, int k) {
  return frame.collider_rows + S * collider_row::count * k;
}
template <class Real, class Scalar>
[[gnu::always_inline]] inline LinkSphere<Real> placed_at(const ChainFrame<Scalar>& frame, int k) {
  const Scalar* const rows = rows_of_collider(frame, k);
  return {vector_at<Real>(rows + collider_row::centre * S), number_at<Real>(rows + collider_row::radius * S)};
}
template <class Real, class Scalar>
[[gnu::always_inline]] inline void place(const ChainFrame<Scalar>& frame, int k, const Vector<Real>& centre,
                                         Real radius) {
  put<Real>(rows_of_collider(frame, k) + collider_row::centre * S, centre);
  put<Real>(rows_of_collider(frame, k) + collider_row::radius * S, radius);
}

/// What of a box or field (in this order) that moves by itself differs from strand to strand.
template <class Scalar>
[[gnu::always_inline]] inline Scalar* carry_rows(const ChainFrame<Scalar>& frame, int k) {
  return rows_of_collider(frame, collider_count(frame)) + S * 3 * k;
}

/// Where the anchor stands at the substep's begin and end, relative to the head's translation; on a skin in the world.
template <class Real>
struct AnchorWay {
  Vector<Real> begin, end;
};
template <class Real, class Scalar>
[[gnu::always_inline]] inline AnchorWay<Real> anchor_way(const ChainStep<Real>& step, const ChainFrame<Scalar>& frame,
                                                         const Vector<Real>& anchor) {
  if (!frame.turns) return {turned_to_begin(step, anchor), turned_to_end(step, anchor)};
  const Scalar* const begin = frame.turns + turn_row::root * S;
  return {vector_at<Real>(begin), vector_at<Real>(begin + turn_row::count * S)};
}

template <class Real, class Scalar>
[[gnu::noinline]] void place_moving(const ChainStep<Real>& step, const ChainFrame<Scalar>& frame,
                                    const Vector<Real>& anchor, Real first_link) {
  const AnchorWay<Real> way = anchor_way(step, frame, anchor);
  const auto keep = [&](int k, const LinkBox<Real>& placed) {
    place(frame, frame.sphere_count + k, placed.centre, placed.radius);
    put<Real>(carry_rows(frame, k), carry_offset(spread<Real>(frame.carries[k]), way.begin, way.end));
  };
  for (int k = 0; k < frame.box_count; ++k) keep(k, moved_box(step, spread<Real>(frame.boxes[k]), way.end, first_link));
  for (int k = 0; k < frame.field_count; ++k)
    keep(frame.box_count + k,
         moved_field(step, spread<Real>(frame.fields[k]), frame.field_values[k], way.end, first_link).grid);
}

/// Spheres, and of boxes and fields what differs from strand to strand.
template <class Real, class Scalar>
[[gnu::always_inline]] inline void place_colliders(const ChainBlock<Scalar>& block, const ChainStep<Real>& step,
                                                   const ChainFrame<Scalar>& frame) {
  const Vector<Real> anchor = vector_at<Real>(block.strand + strand_row::anchor * S);
  const Real first_link = VertexRows<Real>(block, 1).rest_at(rest_row::length);
  const auto keep = [&](int k, const Vector<Real>& at_rest, const Vector<Real>& centre, Real radius, Real around) {
    Scalar* const rows = rows_of_collider(frame, k);
    place(frame, k, centre, radius);
    put<Real>(rows + collider_row::around * S, around);
    put<Real>(rows + collider_row::begin * S, turned_to_begin(step, at_rest - anchor));
  };
  for (int k = 0; k < frame.sphere_count; ++k) {
    const LinkSphere<Real> sphere = spread<Real>(frame.spheres[k]);
    const LinkSphere<Real> placed = link_sphere(step, sphere.centre, sphere.radius, anchor, first_link);
    keep(k, sphere.centre, placed.centre, placed.radius, placed.radius);
  }
  if (frame.carries) return place_moving(step, frame, anchor, first_link);
  for (int k = 0; k < frame.box_count; ++k) {
    const LinkBox<Real> box = spread<Real>(frame.boxes[k]), placed = link_box(step, box, anchor, first_link);
    keep(frame.sphere_count + k, box.centre, placed.centre, placed.radius, sphere_around(placed).radius);
  }
  for (int k = 0; k < frame.field_count; ++k) {
    const LinkField<Real> field = spread<Real>(frame.fields[k]);
    const LinkBox<Real> placed = link_field(step, field, frame.field_values[k], anchor, first_link).grid;
    keep(frame.sphere_count + frame.box_count + k, field.grid.centre, placed.centre, placed.radius,
         sphere_around(placed).radius);
  }
}

/// Whether a link of this length below `place` may meet a collider at the substep's end; beside such as move by
/// themselves every one may.
template <class Real, class Scalar>
[[gnu::always_inline]] inline bool may_meet(const ChainFrame<Scalar>& frame, const Vector<Real>& place, Real length) {
  if (frame.carries) return true;
  for (int k = 0; k < collider_count(frame); ++k) {
    const Real around = number_at<Real>(rows_of_collider(frame, k) + collider_row::around * S);
    if (any(is_within(LinkSphere<Real>{placed_at<Real>(frame, k).centre, around}, place, length))) return true;
  }
  return false;
}
template <class Real, class Scalar>
[[gnu::always_inline]] inline bool link_below_may_meet(const ChainBlock<Scalar>& block, int i,
                                                       const ChainFrame<Scalar>& frame, const Vector<Real>& place) {
  return may_meet(frame, place, VertexRows<Real>(block, i + 1).rest_at(rest_row::length));
}
/// Whether vertex i, predicted at `place`, may be in a collider there or where the substep begins.
template <class Real, class Scalar>
[[gnu::always_inline]] inline bool is_beside(const ChainBlock<Scalar>& block, int i, const ChainFrame<Scalar>& frame,
                                             const Vector<Real>& place) {
  if (may_meet(frame, place, Real(0))) return true;
  const Vector<Real> here = VertexRows<Real>(block, i).state_vector(state_row::here);
  for (int k = 0; k < collider_count(frame); ++k) {
    const Scalar* const rows = rows_of_collider(frame, k);
    const LinkSphere<Real> begin{vector_at<Real>(rows + collider_row::begin * S),
                                 number_at<Real>(rows + collider_row::around * S)};
    if (any(is_within(begin, here, Real(0)))) return true;
  }
  return false;
}

/// The vertices that a contact may have moved in this substep: what is kept of contacts (Touch) stands in their rows,
/// and is nothing for all others.
struct Beside {
  int first = 0, last = -1;
  [[gnu::always_inline]] bool contains(int i) const { return first <= i && i <= last; }
};
/// To vertex i and its parent, whose rows, as those of all that were left out, become those of no contact.
template <class Real, class Scalar>
[[gnu::noinline]] void widen(const ChainBlock<Scalar>& block, int i, Beside& beside) {
  if (beside.last < 0) beside = {i - 1, i - 2};
  for (; beside.last < i; ++beside.last) {
    const VertexRows<Real> v(block, beside.last + 1);
    v.put_scratch(scratch_row::normal, Vector<Real>(Real(0)));
    v.put_scratch(scratch_row::second_normal, Vector<Real>(Real(0)));
    v.put_scratch(scratch_row::edge, Real(0));
    v.put_scratch(scratch_row::begin_pushed, Vector<Real>(Real(0)));
  }
}

}  // namespace
}  // namespace cuticle::sim::chains
