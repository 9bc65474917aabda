// Substeps of blocks of strands for one instruction set: compiled several times (CMakeLists.txt) with CUTICLE_BATCH.
#define CUTICLE_ESTIMATES
#include "sim/exact/kernel.h"
#include "sim/chains/lanes/chain_lanes.h"

namespace cuticle::sim::exact {
namespace {

using namespace chains;

/// What forces move a vertex, and its mass against the lengths over its own.
template <bool Pulls, class Real>
[[gnu::always_inline]] inline Displacement<Real> displacement(const VertexRows<Real>& v, const ChainStep<Real>& step,
                                                              const StrandStep<Real>& strand, const Vector<Real>& from,
                                                              const Vector<Real>& inertial) {
  if constexpr (!Pulls) return free_displacement(step, strand, inertial);
  const Vector<Real> rest = v.rest_vector(rest_row::target), target = turned_to_end(step, rest);
  return pulled_displacement(step, strand, inertial, v.rest_at(rest_row::pull), target - from,
                             target - turned_to_begin(step, rest) + strand.root_step);
}

/// Tip to root: the scheme's prediction, and the lagged tensions' elimination.
template <bool Pulls, class Real>
[[gnu::always_inline]] inline void predict(const VertexRows<Real>& v, const ChainStep<Real>& step,
                                           const StrandStep<Real>& strand, TensionCarry<Real>& below) {
  const ChainVertex<Real> vertex = chain_vertex(v);
  const Vector<Real> from = scheme_from(vertex, strand), inertial = inertial_displacement(vertex, strand);
  const Displacement<Real> d = displacement<Pulls>(v, step, strand, from, inertial);
  TensionCarry<Real> carry;
  const Led<Real> place = led(from + d.moved, v.rest_at(rest_row::mass) * d.inertia,
                              v.state_at(state_row::tension) * (strand.time * strand.time), below, carry);
  below = carry;
  keep_before(v, vertex, strand, from);
  v.put_scratch(scratch_row::place, place.place);
  v.put_scratch(scratch_row::follows, place.follows);
  if constexpr (Pulls)
    v.put_scratch(scratch_row::inverse_mass, v.rest_at(rest_row::inverse_mass) * reciprocal(d.inertia));
}

/// Of a vertex against the lengths.
template <bool Pulls, class Real>
[[gnu::always_inline]] inline Real inverse_mass_of(const VertexRows<Real>& v) {
  return Pulls ? v.scratch_at(scratch_row::inverse_mass) : v.rest_at(rest_row::inverse_mass);
}

/// A vertex out of reach, folded back onto its parent's link or so near to its parent that its link points nowhere.
template <bool Touches, class Real>
[[gnu::always_inline]] inline void mend(const VertexRows<Real>& v, const VertexRows<Real>& above,
                                        const LinkCarry<Real>& parent, const Vector<Real>& side, Vector<Real>& place,
                                        Vector<Real>& direction) {
  const Real length = v.rest_at(rest_row::length);
  if constexpr (!Touches) place = within_reach(place, v.rest_at(rest_row::reach));
  const Vector<Real> before =
      (v.state_vector(state_row::before) - above.state_vector(state_row::before)) * v.rest_at(rest_row::inverse_length);
  direction = direction_or(place - parent.place, Real(1e-3) * length, before);
  place = fold_opened(place, parent, direction, length, side);
}

/// Root to tip: where the tensions let a vertex be.
template <class Real>
[[gnu::always_inline]] inline Vector<Real> lead(const VertexRows<Real>& v, const Vector<Real>& parent) {
  return v.scratch_vector(scratch_row::place) + parent * v.scratch_at(scratch_row::follows);
}

/// A vertex led to `place` and the link above it, pushed out of colliders: where that leaves the vertex.
template <class Real, class Scalar>
[[gnu::noinline]] Vector<Real> push(const VertexRows<Real>& v, const VertexRows<Real>& above,
                                    const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                    const Vector<Real>& place) {
  const Vector<Real> parent = above.scratch_vector(scratch_row::place), here = v.state_vector(state_row::here);
  const Real follows = v.scratch_at(scratch_row::follows);
  const Touch<Real> touch = pushed_from_all(frame, step, here, place);
  keep_touch(v, frame, touch);
  const PredictedLink<Real> link = pressed_from_all(v, above, frame, step, {above.state_vector(state_row::here), here},
                                                    parent, follows, touch, Real(-2));
  above.put_scratch(scratch_row::place, link.parent);
  return link.child;
}

/// The same for all vertices.
template <class Real, class Scalar>
[[gnu::always_inline]] inline Beside lead_beside(const ChainBlock<Scalar>& block, const ChainFrame<Scalar>& frame,
                                                 const ChainStep<Real>& step) {
  Beside beside;
  Vector<Real> place(Real(0));
  bool is_near = link_below_may_meet(block, 0, frame, place);
  for (int i = 1; i <= block.links; ++i) {
    const VertexRows<Real> v(block, i);
    place = lead(v, place);
    const Real reach = v.rest_at(rest_row::reach);
    if (any(is_far(place, reach))) place = within_reach(place, reach);
    if (is_near || is_beside(block, i, frame, place)) {
      widen<Real>(block, i, beside);
      place = push(v, VertexRows<Real>(block, i - 1), frame, step, place);
    }
    is_near = link_below_may_meet(block, i, frame, place);
    v.put_scratch(scratch_row::place, place);
  }
  return beside;
}

/// The link's row of the lengths' elimination. What is rare is mended apart, so that no link waits for it.
template <bool Pulls, bool Touches, class Real, class Scalar>
[[gnu::always_inline]] inline LinkCarry<Real> eliminate(const ChainBlock<Scalar>& block, int i,
                                                        const ChainStep<Real>& step, const Beside& beside,
                                                        const LinkCarry<Real>& parent) {
  const VertexRows<Real> v(block, i), above(block, i - 1);
  const Real length = v.rest_at(rest_row::length), inverse_mass = inverse_mass_of<Pulls>(v);
  Vector<Real> normal(Real(0)), second(Real(0)),
      place = Touches ? v.scratch_vector(scratch_row::place) : lead(v, parent.place);
  if (Touches && beside.contains(i)) {
    normal = v.scratch_vector(scratch_row::normal);
    second = v.scratch_vector(scratch_row::second_normal);
  }
  Vector<Real> link = place - parent.place, direction = link * reciprocal_root(inner(link, link));
  if (any(is_short(link, Real(1e-3) * length) || is_far(place, v.rest_at(rest_row::reach)) ||
          is_folded(direction, parent)))
    mend<Touches>(v, above, parent, i % 2 ? step.end_x : step.end_y, place, direction);
  LinkMasses<Real> masses = free_masses(parent, direction, inverse_mass);
  if (Touches && (beside.contains(i) || beside.contains(i - 1)))
    masses = touching_masses(parent, direction, normal, second, inverse_mass);
  LinkRow<Real> row;
  const LinkCarry<Real> carry = eliminated(parent, masses, place, direction, normal, second, inverse_mass, length, row);
  v.put_scratch(scratch_row::place, place);
  v.put_scratch(scratch_row::direction, direction);
  v.put_scratch(scratch_row::coupling, row.coupling);
  v.put_scratch(scratch_row::value, row.value);
  return carry;
}

template <class Real, class Scalar>
[[gnu::always_inline]] inline void substitute(const ChainBlock<Scalar>& block) {
  Real coupling_below(0), below(0);
  for (int i = block.links; i >= 1; --i) {
    const VertexRows<Real> v(block, i);
    below = multiplier(v.scratch_at(scratch_row::value), coupling_below, below);
    coupling_below = v.scratch_at(scratch_row::coupling);
    v.put_scratch(scratch_row::value, below);
  }
}

/// Where the Newton step puts a vertex: link multipliers times directions of the link above (`pull`, which becomes that
/// of the one below) and below it.
template <bool Pulls, bool Touches, class Real, class Scalar>
[[gnu::always_inline]] inline NewtonPlace<Real> newton_step(const ChainBlock<Scalar>& block, int i,
                                                            const StrandStep<Real>& strand, const Beside& beside,
                                                            Vector<Real>& pull) {
  const VertexRows<Real> v(block, i), below(block, i + 1);
  const Vector<Real> under = below.scratch_vector(scratch_row::direction) * below.scratch_at(scratch_row::value);
  Vector<Real> moved = (pull - under) * inverse_mass_of<Pulls>(v);
  pull = under;
  if (Touches && beside.contains(i)) {
    moved = along_surface(moved, v.scratch_vector(scratch_row::normal));
    moved = along_surface(moved, v.scratch_vector(scratch_row::second_normal));
  }
  Real change = v.scratch_at(scratch_row::value);
  if constexpr (Touches) change = change * tension_share(strand);
  v.put_state(state_row::tension, next_tension(v.state_at(state_row::tension), change,
                                               v.rest_at(rest_row::inverse_length), strand.inverse_time));
  return {v.scratch_vector(scratch_row::place) + moved, v.scratch_vector(scratch_row::direction)};
}

/// What a frame touches of vertex i in the block that lies after this one, and that the thread takes next, begins to
/// come to the cache: many strands have no room there. In every substep: in one of them alone it helped less.
template <bool Pulls, class Scalar>
[[gnu::always_inline]] inline void fetch_next(const ChainBlock<Scalar>& block, int i) {
  const auto fetch = [&](const Scalar* rows, int count, int wanted) {
    const std::uintptr_t next = std::uintptr_t(rows) + std::size_t((block.links + 2 + i) * count * S) * sizeof(Scalar);
    for (int row = 0; row < wanted; ++row)
      __builtin_prefetch(reinterpret_cast<const void*>(next + std::size_t(row * S) * sizeof(Scalar)), 1, 2);
  };
  fetch(block.rest, rest_row::count, Pulls ? rest_row::count : rest_row::pull);
  fetch(block.state, state_row::count, state_row::count);
}

/// As dissipate wants it.
template <bool Pulls, class Real, class Scalar>
struct Forces {
  const ChainBlock<Scalar>& block;
  const ChainStep<Real>& step;
  Displacement<Real> displaced(int i, const StrandStep<Real>& strand, const Vector<Real>& begin) const {
    const VertexRows<Real> v(block, i);
    return displacement<Pulls>(v, step, strand, begin, v.state_vector(state_row::velocity_before) * strand.time);
  }
  Real stored(const StrandStep<Real>&) const { return Real(0); }
};

template <bool Pulls, bool Touches, class Real, class Scalar>
void substep(const ChainBlock<Scalar>& block, const ChainFrame<Scalar>& frame, const ChainStep<Real>& step) {
  const StrandStep<Real> strand = begin(block, step);
  if constexpr (Touches) place_colliders(block, step, frame);
  TensionCarry<Real> below = below_tip<Real>();
  for (int i = block.links; i >= 1; --i) {
    fetch_next<Pulls>(block, i);
    predict<Pulls>(VertexRows<Real>(block, i), step, strand, below);
  }
  Beside beside;
  if constexpr (Touches) beside = lead_beside(block, frame, step);
  LinkCarry<Real> parent = at_anchor<Real>();
  for (int i = 1; i <= block.links; ++i) parent = eliminate<Pulls, Touches>(block, i, step, beside, parent);
  substitute<Real>(block);
  const VertexRows<Real> first(block, 1);
  Vector<Real> pull = first.scratch_vector(scratch_row::direction) * first.scratch_at(scratch_row::value);
  follow_all<Touches>(block, frame, step, strand, beside, Forces<Pulls, Real, Scalar>{block, step},
                      [&](int i) { return newton_step<Pulls, Touches>(block, i, strand, beside, pull); });
}

template <class Scalar, bool Pulls, bool Touches>
void advance(const ChainBlock<Scalar>& block, const ChainFrame<Scalar>& frame) {
  advance_parts(block, frame,
                [&](const ChainBlock<Scalar>& part, const ChainFrame<Scalar>& now,
                    const ChainStep<Lanes<Scalar>>& step) { substep<Pulls, Touches>(part, now, step); });
}

}  // namespace

extern const Kernels CUTICLE_JOIN(kernels_, CUTICLE_BATCH_SET);
const Kernels CUTICLE_JOIN(kernels_, CUTICLE_BATCH_SET) = {{{advance<float, false, false>, advance<float, false, true>},
                                                            {advance<float, true, false>, advance<float, true, true>}},
                                                           advance<double, true, true>};

}  // namespace cuticle::sim::exact
