#pragma once
// What the solvers of rigid links do with all lanes of a block, for their units of one instruction set (row_lanes.h).
#include "core/flush_to_zero.h"
#include "sim/chains/contact/dissipation.glslh"
#include "sim/chains/lanes/contact_lanes.h"

namespace cuticle::sim::chains {
namespace {

/// Where the Newton step put a vertex; where its link points if that says nothing.
template <class Real>
struct NewtonPlace {
  Vector<Real> place, fallback;
};
/// What the way down carries from parent to child.
template <class Real>
struct Following {
  Vector<Real> newton, place, velocity, pushed;
  Real excess, free_parent, kept;
};

/// The link at its length, the velocities, and the share of the clean-up that the parent's velocity gives back.
template <bool Touches, class Real>
[[gnu::always_inline]] inline void follow(const VertexRows<Real>& v, const VertexRows<Real>& parent,
                                          const StrandStep<Real>& strand, const Vector<Real>& newton,
                                          const Vector<Real>& aim, Following<Real>& f) {
  const Real length = v.rest_at(rest_row::length);
  const Vector<Real> place = f.place + aim * length;
  Vector<Real> moved = place - newton;
  if constexpr (Touches) {
    f.pushed = pushed_along(f.pushed, aim);
    moved = moved - f.pushed;
  }
  Vector<Real> pull = cleanup_pull(moved, length, v.rest_at(rest_row::mass_ratio), strand.inverse_time);
  if constexpr (Touches) {
    pull *= f.free_parent;
    f.free_parent = Real(1);
    f.kept = Real(0);
  }
  parent.put_state(state_row::velocity, f.velocity - pull);
  f.velocity = (place - v.state_vector(state_row::velocity)) * strand.inverse_time;
  f.place = place;
}

/// The same beside colliders; `kept`: what the prediction kept of contacts. What a contact moved says nothing of the
/// pull on the parent, and a parent in contact feels none.
template <class Real, class Scalar>
[[gnu::noinline]] Following<Real> follow_beside(const VertexRows<Real>& v, const VertexRows<Real>& parent,
                                                const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                                const StrandStep<Real>& strand, const Vector<Real>& newton,
                                                const Vector<Real>& aim, const Touch<Real>& kept, Following<Real> f) {
  const Real length = v.rest_at(rest_row::length);
  Vector<Real> normal = kept.normal;
  Real touched = kept.collider;
  const Leaving<Real> out = leaving_of(kept.begin_pushed, leaving(step));
  const Vector<Real> turned =
                         turned_out_of_all(frame, step, f.place, aim, length, max(f.kept, out.kept), normal, touched),
                     aimed = f.place + aim * length, place = f.place + turned * length, turn = place - aimed,
                     pushed = pushed_along(f.pushed, aim);
  const Vector<Real> pull =
      cleanup_pull(aimed - newton - pushed, length, v.rest_at(rest_row::mass_ratio), strand.inverse_time);
  parent.put_state(state_row::velocity, f.velocity - pull * f.free_parent);
  const auto touches = inner(normal, normal) > Real(0);
  const Vector<Real> begin = v.state_vector(state_row::before), here = begin + strand.root_step;
  Vector<Real> carried = carried_by_head(step, here);
  if (frame.carries) carried = carried_by_moving(frame, carried, here, touched);
  const Touch<Real> touch{place, normal, out.moved, touched};
  const Vector<Real> beside =
      touching_velocity(place, begin, carried, touch, sqrt(inner(turn, turn)), step.friction, step.per_second);
  f.velocity = either(touches, beside, (place - v.state_vector(state_row::velocity)) * strand.inverse_time);
  f.place = place;
  f.pushed = pushed + turn;
  f.kept = out.kept;
  f.free_parent = selected(touches, Real(0), Real(1));
  f.excess = selected(touches, Real(1), f.excess);
  return f;
}

/// How far a vertex went from where the head takes it, less what leaving an overlap moved it; the head's way; and where
/// from both are.
template <class Real>
struct Ways {
  Vector<Real> begin, carried, surface, way;
};
template <class Real>
[[gnu::always_inline]] inline Ways<Real> ways_of(const VertexRows<Real>& v, const ChainStep<Real>& step,
                                                 const StrandStep<Real>& strand) {
  const Vector<Real> begin = v.state_vector(state_row::before),
                     carried = carried_by_head(step, begin + strand.root_step),
                     left = leaving_of(v.scratch_vector(scratch_row::begin_pushed), leaving(step)).moved;
  return {begin, carried, carried - begin, v.state_vector(state_row::here) - carried - left};
}

/// How many links of each strand lie over edges.
template <class Real, class Scalar>
[[gnu::always_inline]] inline Real edges_beside(const ChainBlock<Scalar>& block, const Beside& beside) {
  Real edges(0);
  for (int i = beside.first; i <= beside.last; ++i) edges += VertexRows<Real>(block, i).scratch_at(scratch_row::edge);
  return edges;
}

/// Takes from the velocities of strands over edges what an exact step would not have left them.
/// `forces.displaced(i, strand, begin)`: what forces move vertex i; `forces.stored(strand)`: as kept_by_contact has it.
/// Colliders that move by themselves do work, so nothing is taken beside them.
template <class Real, class Scalar, class Forces>
[[gnu::noinline]] void dissipate(const ChainBlock<Scalar>& block, const ChainStep<Real>& step,
                                 const StrandStep<Real>& strand, Real edges, const Forces& forces) {
  const StrandStep<Real> euler = first_order(step, strand);
  Work<Real> work = no_work<Real>();
  for (int i = 1; i <= block.links; ++i) {
    const VertexRows<Real> v(block, i);
    const Ways<Real> ways = ways_of(v, step, strand);
    const Displacement<Real> free = forces.displaced(i, euler, ways.begin);
    work = with_vertex(work, v.rest_at(rest_row::mass) * free.inertia, ways.way, free.moved - ways.surface,
                       v.state_vector(state_row::velocity) * step.duration - ways.surface,
                       v.state_vector(state_row::velocity_before) * step.duration - ways.surface, step.duration);
  }
  const Real kept = selected(edges > Real(0), kept_by_contact(work, forces.stored(strand)), Real(1));
  if (!any(kept < Real(1))) return;
  for (int i = 1; i <= block.links; ++i) {
    const VertexRows<Real> v(block, i);
    const Vector<Real> surface = ways_of(v, step, strand).surface * step.per_second;
    v.put_state(state_row::velocity, surface + (v.state_vector(state_row::velocity) - surface) * kept);
  }
}

/// All links down from the anchor: `newton_of(i)` is the NewtonPlace of vertex i.
template <bool Touches, class Real, class Scalar, class NewtonOf, class Forces>
[[gnu::always_inline]] inline void follow_all(const ChainBlock<Scalar>& block, const ChainFrame<Scalar>& frame,
                                              const ChainStep<Real>& step, const StrandStep<Real>& strand,
                                              const Beside& beside, const Forces& forces, const NewtonOf& newton_of) {
  const Vector<Real> zero(Real(0));
  Following<Real> f{zero, zero, strand.root_step * step.per_second, zero, Real(0), Real(0), Real(0)};
  for (int i = 1; i <= block.links; ++i) {
    const VertexRows<Real> v(block, i), parent(block, i - 1);
    const NewtonPlace<Real> newton = newton_of(i);
    const Real length = v.rest_at(rest_row::length);
    f.excess = max(f.excess, excess_of_newton(newton.place - f.newton, length));
    f.newton = newton.place;
    const Vector<Real> aim = direction_or(newton.place - f.place, Real(1e-3) * length, newton.fallback);
    if (Touches && (beside.contains(i) || may_meet(frame, f.place, length)))
      f = follow_beside(v, parent, frame, step, strand, newton.place, aim, kept_touch(v, frame, beside.contains(i)), f);
    else
      follow<Touches>(v, parent, strand, newton.place, aim, f);
    v.put_state(state_row::here, f.place);
  }
  VertexRows<Real>(block, block.links).put_state(state_row::velocity, f.velocity);
  if constexpr (Touches) {
    const Real edges = edges_beside<Real>(block, beside);
    if (!frame.carries && any(edges > Real(0))) dissipate(block, step, strand, edges, forces);
  }
  put<Real>(block.strand + strand_row::guarded * S, selected(f.excess > Real(0), Real(1), Real(0)));
}

/// What is read above the first and below the last vertex.
template <class Real, class Scalar>
[[gnu::always_inline]] inline void clear_ends(const ChainBlock<Scalar>& block) {
  for (int row = 0; row < block.scratch_rows; ++row) {
    VertexRows<Real>(block, 0).put_scratch(row, Real(0));
    VertexRows<Real>(block, block.links + 1).put_scratch(row, Real(0));
  }
}

/// Of a substep and a part of the lanes: the colliders, and the skin's moments from its begin on.
template <class Scalar>
[[gnu::always_inline]] inline ChainFrame<Scalar> of_substep(const ChainFrame<Scalar>& frame, int k, int first) {
  ChainFrame<Scalar> now = frame;
  if (frame.turns) now.turns += first + k * turn_row::count * S;
  if (!frame.carries) return now;
  now.boxes += k * frame.box_count;
  now.fields += k * frame.field_count;
  now.carries += k * (frame.box_count + frame.field_count);
  return now;
}

/// On a skin every strand has a head of its own.
template <class Real, class Scalar>
[[gnu::always_inline]] inline void turn_on_skin(ChainStep<Real>& step, const Scalar* begin) {
  const Scalar* const end = begin + turn_row::count * S;
  step.begin_x = vector_at<Real>(begin + turn_row::x * S);
  step.begin_y = vector_at<Real>(begin + turn_row::y * S);
  step.begin_z = vector_at<Real>(begin + turn_row::z * S);
  step.end_x = vector_at<Real>(end + turn_row::x * S);
  step.end_y = vector_at<Real>(end + turn_row::y * S);
  step.end_z = vector_at<Real>(end + turn_row::z * S);
  step.head_step = vector_at<Real>(end + turn_row::step * S);
}

/// All substeps of a frame, part by part.
template <class Scalar, class Substep>
[[gnu::always_inline]] inline void advance_parts(const ChainBlock<Scalar>& block, const ChainFrame<Scalar>& frame,
                                                 const Substep& substep) {
  [[maybe_unused]] const FlushToZero guard;
  for (int first = 0; first < S; first += Lanes<Scalar>::count) {
    ChainBlock<Scalar> part = block;
    part.rest += first;
    part.state += first;
    part.strand += first;
    part.own += block.own ? first : 0;
    clear_ends<Lanes<Scalar>>(part);
    for (int k = 0; k < frame.count; ++k) {
      ChainStep<Lanes<Scalar>> step = spread<Lanes<Scalar>>(frame.steps[k]);
      const ChainFrame<Scalar> now = of_substep(frame, k, first);
      if (now.turns) turn_on_skin(step, now.turns);
      substep(part, now, step);
    }
  }
}

}  // namespace
}  // namespace cuticle::sim::chains
