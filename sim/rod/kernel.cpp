// Substeps of blocks of strands for one instruction set: compiled several times (CMakeLists.txt) with CUTICLE_BATCH.
#include <utility>

#include "sim/chains/lanes/chain_lanes.h"
#include "sim/rod/kernel.h"
#include "sim/rod/rod_step.glslh"

namespace cuticle::sim::chains {
namespace {
/// Round-off is that of the numbers in the pack.
template <class Number, int N>
[[gnu::always_inline]] inline Pack<Number, N> smallest_pivot(Pack<Number, N> size) {
  return sim::smallest_pivot(Number(1)) * size;
}
}  // namespace
}  // namespace cuticle::sim::chains

namespace cuticle::sim::rod {
namespace {
using namespace chains;

/// The band's numbers of a vertex: rows in memory, or packs of which every index is known, which need no memory.
template <class Real>
struct BandRows {
  Real* packs;
  typename Real::Scalar* rows;
};
template <class Real>
struct BandNumber {
  BandRows<Real> band;
  int row;
  [[gnu::always_inline]] operator Real() const {
    return band.packs ? band.packs[row] : number_at<Real>(band.rows + row * Real::count);
  }
  [[gnu::always_inline]] void operator=(Real value) const {
    if (band.packs)
      band.packs[row] = value;
    else
      put<Real>(band.rows + row * Real::count, value);
  }
};
constexpr int k_band_rows = rod_row::pushed - rod_row::band;

#define ROWS BandRows<Real>
#define UNROLLED _Pragma("GCC unroll 9")
#define FROM_8_DOWN_TO_ABOVE(m, j) UNROLLED for (int m = 8; m > j; --m)
#define AT(rows, row) (BandNumber<Real>{rows, row})
#define BAND_BEGIN 0
#define RIGHT_BEGIN (rod_row::right - rod_row::band)
#include "sim/rod/rod_band.glslh"

/// A block, and a vertex of it with its hinge.
template <class Real>
struct RodVertex : VertexRows<Real> {
  using typename VertexRows<Real>::Scalar;
  Scalar* hinge;
  [[gnu::always_inline]] RodVertex(const ChainBlock<Scalar>& block, int i)
      : VertexRows<Real>(block, i), hinge(block.own + i * hinge_row::count * S) {}
  [[gnu::always_inline]] Real hinge_at(int row) const { return number_at<Real>(hinge + row * S); }
  [[gnu::always_inline]] Vector<Real> hinge_vector(int row) const { return vector_at<Real>(hinge + row * S); }
  [[gnu::always_inline]] BandRows<Real> band() const { return {nullptr, this->scratch + rod_row::band * Real::count}; }
};

/// Root to tip: where vertices go by inertia, before as above the places of their parents.
template <class Real>
struct Coasting {
  Vector<Real> here, place, inertial, predicted;
};
/// What forces other than bending move a vertex, and its mass against bending and lengths over its own, which is kept.
template <bool Pulls, class Real>
[[gnu::always_inline]] inline Displacement<Real> displacement(const RodVertex<Real>& v, const ChainStep<Real>& step,
                                                              const StrandStep<Real>& strand, const Vector<Real>& from,
                                                              const Vector<Real>& drift) {
  if constexpr (!Pulls) return free_displacement(step, strand, drift);
  const Vector<Real> rest = v.rest_vector(rest_row::target), target = turned_to_end(step, rest);
  const Displacement<Real> pulled = pulled_displacement(step, strand, drift, v.rest_at(rest_row::pull), target - from,
                                                        target - turned_to_begin(step, rest) + strand.root_step);
  v.put_scratch(rod_row::inertia, pulled.inertia);
  return pulled;
}

/// What the tensions of the last substep move vertex i.
template <class Real, class Scalar>
[[gnu::always_inline]] inline Vector<Real> pull_of_links(const ChainBlock<Scalar>& block, int i, Real time) {
  const RodVertex<Real> v(block, i), above(block, i - 1), child(block, i + 1);
  const Vector<Real> here = v.state_vector(state_row::here);
  return pulled_by_links(above.state_vector(state_row::here) - here, child.state_vector(state_row::here) - here,
                         v.state_at(state_row::tension) * (time * time),
                         child.state_at(state_row::tension) * (time * time), v.rest_at(rest_row::inverse_mass),
                         Real(0.5) * v.rest_at(rest_row::length));
}

/// Vertex i, predicted at `predicted`, and the link above it, pushed out of colliders; friction is the band's.
template <class Real, class Scalar>
[[gnu::always_inline]] inline Vector<Real> push(const ChainBlock<Scalar>& block, int i, const ChainFrame<Scalar>& frame,
                                                ChainStep<Real> step, const LinkBegin<Real>& here,
                                                const Vector<Real>& parent, const Vector<Real>& predicted,
                                                Beside& beside) {
  const RodVertex<Real> v(block, i), above(block, i - 1);
  step.friction = Real(0);
  const Vector<Real> above_pushed = above.scratch_vector(scratch_row::normal);
  const Touch<Real> touch = pushed_from_all(frame, step, here.child, predicted);
  keep_touch<Real>(v, frame, touch);
  const PredictedLink<Real> link =
      pressed_from_all<Real>(v, above, frame, step, here, parent, Real(0), touch, Real(0.9));
  const Vector<Real> parent_moved = link.parent - parent;
  above.put_scratch(rod_row::pushed, above.scratch_vector(rod_row::pushed) + parent_moved);
  above.put_scratch(scratch_row::normal, above_pushed + push_along(parent_moved, link.parent_normal));
  v.put_scratch(rod_row::pushed, link.child - predicted);
  v.put_scratch(scratch_row::normal, push_along(touch.place - predicted, touch.normal) +
                                         push_along(link.child - touch.place, link.child_normal));
  if (is_in_contact(touch, link)) beside = {beside.last < 0 ? i - 1 : beside.first, i};
  return link.child;
}

template <bool Pulls, bool Touches, class Real, class Scalar>
[[gnu::always_inline]] inline void predict(const ChainBlock<Scalar>& block, int i, const ChainFrame<Scalar>& frame,
                                           const ChainStep<Real>& step, const StrandStep<Real>& strand, Real arc,
                                           Coasting<Real>& parent, Beside& beside) {
  const RodVertex<Real> v(block, i);
  const ChainVertex<Real> vertex = chain_vertex(v);
  const Vector<Real> from = scheme_from(vertex, strand), drift = inertial_displacement(vertex, strand);
  const Displacement<Real> displaced = displacement<Pulls>(v, step, strand, from, drift);
  Vector<Real> fall = fall_of(step, strand.time);
  if constexpr (Pulls) fall = pulled_fall(fall, step, strand.time, displaced.inertia);
  const InertialPrediction<Real> c = inertial_prediction(vertex.here, from, drift, displaced.moved, fall, arc);
  const Real length = v.rest_at(rest_row::length);
  const Vector<Real> before = (vertex.here - parent.here) * v.rest_at(rest_row::inverse_length),
                     direction = direction_or(c.place - parent.place, Real(1e-3) * length, before);
  const Vector<Real> here_above = parent.here;
  parent = {vertex.here, c.place, parent.inertial + direction * length, parent.predicted};
  v.put_scratch(rod_row::inertial, parent.inertial);
  v.put_scratch(scratch_row::direction, direction);
  if constexpr (Touches)
    parent.predicted = push(block, i, frame, step, {here_above, vertex.here}, parent.predicted,
                            vertex.here + c.moved + pull_of_links<Real>(block, i, strand.time), beside);
  v.put_scratch(scratch_row::place, (vertex.here - parent.inertial) + c.moved);
  keep_before(v, vertex, strand, from);
}

template <class Real>
struct Bending {
  Vector<Real> direction, director;
  Real angle;
};
/// The clamp's direction and director stand where a vertex has its own.
template <class Real>
[[gnu::always_inline]] inline Bending<Real> clamped(const RodVertex<Real>& root, const ChainStep<Real>& step) {
  const Vector<Real> direction = turned_to_end(step, root.hinge_vector(clamp_row::direction));
  root.put_scratch(scratch_row::direction, direction);
  return {direction, turned_to_end(step, root.hinge_vector(clamp_row::director)),
          sane_angle(root.hinge_at(hinge_row::angle))};
}

template <class Real>
[[gnu::always_inline]] inline void bend(const RodVertex<Real>& v, Bending<Real>& parent) {
  const Vector<Real> here = v.scratch_vector(scratch_row::direction);
  const Real angle = sane_angle(v.hinge_at(hinge_row::angle)), stiffness = v.hinge_at(hinge_row::stiffness);
  const Hinge<Real> hinge = hinge_between(parent.direction, here, parent.director, v.hinge_at(hinge_row::bend_x),
                                          v.hinge_at(hinge_row::bend_y), Real(0.5) * (parent.angle + angle));
  v.put_scratch(rod_row::natural, hinge.natural);
  v.put_scratch(rod_row::natural_spin, hinge.natural_spin);
  v.put_scratch(rod_row::across, hinge.across);
  v.put_scratch(rod_row::along, hinge.along);
  v.put_scratch(rod_row::moment, stiffness * spin_moment(hinge));
  v.put_scratch(rod_row::rounding, stiffness * spin_stiffness(hinge));
  parent = {here, transported(parent.director, parent.direction, here), angle};
}

template <class Real>
[[gnu::always_inline]] inline AngleHinge<Real> angle_hinge(const RodVertex<Real>& v, const RodVertex<Real>& parent) {
  const Real stiffness = v.hinge_at(hinge_row::twist);
  const Real turned = sane_angle(v.hinge_at(hinge_row::angle)) - sane_angle(parent.hinge_at(hinge_row::angle)) -
                      v.hinge_at(hinge_row::natural_angle);
  return {stiffness, v.scratch_at(rod_row::moment), v.scratch_at(rod_row::rounding), stiffness * turned};
}

/// The angles' step: eliminated from the root, substituted from the tip.
template <class Real, class Scalar>
[[gnu::always_inline]] inline void turn_angles(const ChainBlock<Scalar>& block) {
  AngleRow<Real> row{Real(0), Real(0)};
  for (int i = 1; i <= block.links; ++i) {
    const RodVertex<Real> v(block, i), parent(block, i - 1), child(block, i + 1);
    row = angle_eliminated(angle_hinge(v, parent), angle_hinge(child, v), row);
    v.put_scratch(rod_row::angle_coupling, row.coupling);
    v.put_scratch(rod_row::angle_value, row.value);
  }
  Real below(0);
  for (int i = block.links; i >= 1; --i) {
    const RodVertex<Real> v(block, i);
    below = limited_turn(multiplier(v.scratch_at(rod_row::angle_value), v.scratch_at(rod_row::angle_coupling), below));
    v.put_scratch(rod_row::angle_value, below);
  }
}

/// What bending pulls with the new angles; `parent` of the one above.
template <class Real>
struct Pulling {
  Vector<Real> direction;
  Real turn, angle;
};
template <class Real>
[[gnu::always_inline]] inline void pull(const RodVertex<Real>& v, Real time, Pulling<Real>& parent) {
  const Real turn = v.scratch_at(rod_row::angle_value), across = v.scratch_at(rod_row::across),
             along = v.scratch_at(rod_row::along), weight = v.hinge_at(hinge_row::stiffness) * (time * time),
             now = sane_angle(v.hinge_at(hinge_row::angle)) + turn,
             twist_weight = v.hinge_at(hinge_row::twist) * (time * time);
  const Vector<Real> natural = spun(v.scratch_vector(rod_row::natural), v.scratch_vector(rod_row::natural_spin),
                                    Real(0.5) * (turn + parent.turn)),
                     here = v.scratch_vector(scratch_row::direction), chord = here - parent.direction;
  put<Real>(v.hinge + hinge_row::angle * S, now);
  v.put_scratch(rod_row::spin_pull, spin_by(parent.direction, here) *
                                        (twist_weight * (now - parent.angle - v.hinge_at(hinge_row::natural_angle))));
  v.put_scratch(rod_row::pull, bending_pull(chord, across, along, natural) * weight);
  v.put_scratch(rod_row::gain, weight * across * along);
  v.put_scratch(rod_row::spin, twist_weight * (along * along - Real(1)));
  parent = {here, turn, now};
}

template <class Real>
[[gnu::always_inline]] inline HingeRow<Real> hinge_row_of(const RodVertex<Real>& v) {
  return {v.scratch_vector(rod_row::pull), v.scratch_vector(rod_row::spin_pull), v.scratch_at(rod_row::gain),
          v.scratch_at(rod_row::spin), v.hinge_at(hinge_row::inverse_length)};
}

/// How the band holds vertex i, which touches.
template <class Real, class Scalar>
[[gnu::noinline]] Grip<Real> grip(const ChainBlock<Scalar>& block, int i, const ChainFrame<Scalar>& frame,
                                  const ChainStep<Real>& step, const StrandStep<Real>& strand, Real mass) {
  const RodVertex<Real> v(block, i);
  const Vector<Real> here = v.state_vector(state_row::here), push = v.scratch_vector(scratch_row::normal),
                     begin = v.state_vector(state_row::before), inertial = v.scratch_vector(rod_row::inertial);
  Vector<Real> carried = carried_by_head(step, here);
  if (frame.carries) carried = carried_by_moving(frame, carried, here, v.scratch_at(scratch_row::touched));
  const Vector<Real> pushed_to = v.scratch_vector(scratch_row::place) + pull_of_links<Real>(block, i, strand.time) +
                                 v.scratch_vector(rod_row::pushed);
  v.put_scratch(scratch_row::normal, direction_or(push, Real(0), Vector<Real>(Real(0))));
  return gripped(pushed_to, carried - inertial, push,
                 v.state_vector(state_row::velocity_before) * step.duration - (carried - begin), mass, step.friction,
                 least_slide(step));
}

/// A vertex' rows of the band.
template <bool Pulls, bool Touches, class Real, class Scalar>
[[gnu::always_inline]] inline void assemble(const ChainBlock<Scalar>& block, int i, const ChainFrame<Scalar>& frame,
                                            const ChainStep<Real>& step, const StrandStep<Real>& strand,
                                            const Beside& beside, const BandRows<Real>& own) {
  const int end = block.links + 1;  // nothing bends past the ends: rows of the end are zero
  const RodVertex<Real> v(block, i), child(block, i + 1), grandchild(block, i + 2 < end ? i + 2 : end),
      above(block, i > 1 ? i - 1 : end);
  const BendRow<Real> bends = bend_row(hinge_row_of(v), hinge_row_of(child), hinge_row_of(grandchild),
                                       above.hinge_at(hinge_row::inverse_length));
  const Real squared = strand.time * strand.time;
  Real inertia = Real(1) + step.drag * strand.time;
  if constexpr (Pulls) inertia = v.scratch_at(rod_row::inertia);
  const Real mass = v.rest_at(rest_row::mass) * inertia, taut = v.state_at(state_row::tension) * squared,
             taut_below = child.state_at(state_row::tension) * squared;
  Grip<Real> held{Vector<Real>(Real(0)), Vector<Real>(Real(0)), Real(0)};
  Vector<Real> wanted = v.scratch_vector(scratch_row::place);
  if (Touches && beside.contains(i)) {
    held = grip(block, i, frame, step, strand, mass);
    wanted += v.scratch_vector(rod_row::pushed);
  }
  put_rows(own, mass + taut + taut_below + bends.diagonal + held.along, bends.beside - taut, bends.beyond,
           v.scratch_vector(scratch_row::direction), held.normal, wanted * mass + held.force + bends.force);
}

template <int C, class Real>
[[gnu::always_inline]] inline void eliminate_row(const BandRows<Real>& own, const BandRows<Real>& parent,
                                                 const BandRows<Real>& grandparent) {
  [&]<int... J>(std::integer_sequence<int, J...>) __attribute__((always_inline)) {
    (eliminate_entry(own, parent, grandparent, C, 8 - J), ...);
  }
  (std::make_integer_sequence<int, 8>());
  eliminate_pivot(own, parent, grandparent, C);
}
template <bool Pulls, bool Touches, class Real, class Scalar>
[[gnu::always_inline]] inline void eliminate_vertex(const ChainBlock<Scalar>& block, int i,
                                                    const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                                    const StrandStep<Real>& strand, const Beside& beside) {
  const RodVertex<Real> parent(block, i - 1), grandparent(block, i > 1 ? i - 2 : 0), v(block, i);
  Real packs[k_band_rows];
  const BandRows<Real> own{packs, nullptr};
  assemble<Pulls, Touches>(block, i, frame, step, strand, beside, own);
  eliminate_row<0>(own, parent.band(), grandparent.band());
  eliminate_row<1>(own, parent.band(), grandparent.band());
  eliminate_row<2>(own, parent.band(), grandparent.band());
  eliminate_row<3>(own, parent.band(), grandparent.band());
  for (int k = 0; k < k_band_rows; ++k) v.put_scratch(rod_row::band + k, packs[k]);
}
template <class Real, class Scalar>
[[gnu::always_inline]] inline void substitute_vertex(const ChainBlock<Scalar>& block, int i) {
  const int end = block.links + 1;
  const BandRows<Real> own = RodVertex<Real>(block, i).band(), child = RodVertex<Real>(block, i + 1).band(),
                       grandchild = RodVertex<Real>(block, i + 2 < end ? i + 2 : end).band();
  substitute_row(own, child, grandchild, 3);
  substitute_row(own, child, grandchild, 2);
  substitute_row(own, child, grandchild, 1);
  substitute_row(own, child, grandchild, 0);
}

template <bool Pulls, bool Touches, class Real, class Scalar>
[[gnu::always_inline]] inline Beside predict_all(const ChainBlock<Scalar>& block, const ChainFrame<Scalar>& frame,
                                                 const ChainStep<Real>& step, const StrandStep<Real>& strand) {
  const Real arc = VertexRows<Real>(block, block.links).rest_at(rest_row::reach);
  const Vector<Real> zero(Real(0));
  Coasting<Real> parent{zero, zero, zero, zero};
  Beside beside;
  for (int i = 1; i <= block.links; ++i) predict<Pulls, Touches>(block, i, frame, step, strand, arc, parent, beside);
  return beside;
}

template <class Real, class Scalar>
[[gnu::always_inline]] inline void bend_all(const ChainBlock<Scalar>& block, const ChainStep<Real>& step, Real time) {
  const RodVertex<Real> root(block, 0);
  Bending<Real> bending = clamped(root, step);
  Pulling<Real> pulling{bending.direction, Real(0), root.hinge_at(hinge_row::angle)};
  for (int i = 1; i <= block.links; ++i) bend(RodVertex<Real>(block, i), bending);
  turn_angles<Real>(block);
  for (int i = 1; i <= block.links; ++i) pull(RodVertex<Real>(block, i), time, pulling);
}

/// A strand that was put back begins with its angles at rest too.
template <class Real, class Scalar>
[[gnu::always_inline]] inline void begin_untwisted(const ChainBlock<Scalar>& block) {
  const auto put_back = number_at<Real>(block.strand + strand_row::guarded * S) > Real(k_was_reset - 0.5);
  if (!any(put_back)) return;
  for (int i = 1; i <= block.links; ++i) {
    const RodVertex<Real> v(block, i);
    put<Real>(v.hinge + hinge_row::angle * S, selected(put_back, Real(0), v.hinge_at(hinge_row::angle)));
  }
}

/// As dissipate wants it.
template <bool Pulls, class Real, class Scalar>
struct Forces {
  const ChainBlock<Scalar>& block;
  const ChainStep<Real>& step;
  Displacement<Real> displaced(int i, const StrandStep<Real>& strand, const Vector<Real>& begin) const {
    const Vector<Real> drift = RodVertex<Real>(block, i).state_vector(state_row::velocity_before) * strand.time;
    return displacement<Pulls>(RodVertex<Real>(block, i), step, strand, begin, drift);
  }
  Real stored(const StrandStep<Real>& strand, Real sum = Real(0)) const {
    Vector<Real> place(Real(0)), carried = place;
    LinkDirections<Real> parent;
    parent.linear = parent.begin = parent.end = RodVertex<Real>(block, 0).scratch_vector(scratch_row::direction);
    for (int i = 1; i <= block.links; ++i) {
      const RodVertex<Real> v(block, i);
      const Vector<Real> here = v.state_vector(state_row::here), begun = ways_of(v, step, strand).carried;
      const LinkDirections<Real> link{v.scratch_vector(scratch_row::direction),
                                      (begun - carried) * v.rest_at(rest_row::inverse_length),
                                      (here - place) * v.rest_at(rest_row::inverse_length)};
      sum += stored_in_hinge(parent, link, v.scratch_vector(rod_row::pull), v.scratch_vector(rod_row::spin_pull),
                             v.scratch_at(rod_row::gain));
      place = here;
      carried = begun;
      parent = link;
    }
    return sum;
  }
};

template <bool Pulls, bool Touches, class Real, class Scalar>
void substep(const ChainBlock<Scalar>& block, const ChainFrame<Scalar>& frame, const ChainStep<Real>& step) {
  begin_untwisted<Real>(block);
  const StrandStep<Real> strand = begin(block, step);
  if constexpr (Touches) place_colliders(block, step, frame);
  const Beside beside = predict_all<Pulls, Touches>(block, frame, step, strand);
  bend_all(block, step, strand.time);
  for (int i = 1; i <= block.links; ++i) eliminate_vertex<Pulls, Touches>(block, i, frame, step, strand, beside);
  for (int i = block.links; i >= 1; --i) substitute_vertex<Real>(block, i);
  follow_all<Touches>(
      block, frame, step, strand, beside, Forces<Pulls, Real, Scalar>{block, step}, [&](int i) -> NewtonPlace<Real> {
        const RodVertex<Real> v(block, i);
        const Real before = v.state_at(state_row::tension),
                   now = next_tension(Real(0), -v.scratch_at(rod_row::right + 3), v.hinge_at(hinge_row::inverse_length),
                                      strand.inverse_time);
        v.put_state(state_row::tension, Touches ? before + (now - before) * tension_share(strand) : now);
        return {v.scratch_vector(rod_row::inertial) + v.scratch_vector(rod_row::right),
                v.scratch_vector(scratch_row::direction)};
      });
}

template <class Scalar, bool Pulls, bool Touches>
void advance(const ChainBlock<Scalar>& block, const ChainFrame<Scalar>& frame) {
  advance_parts(block, frame,
                [&](const ChainBlock<Scalar>& part, const ChainFrame<Scalar>& now,
                    const ChainStep<Lanes<Scalar>>& step) { substep<Pulls, Touches>(part, now, step); });
}

}  // namespace

extern const Kernels CUTICLE_JOIN(kernels_, CUTICLE_BATCH_SET);
const Kernels CUTICLE_JOIN(kernels_, CUTICLE_BATCH_SET) = {
    {{advance<float, false, false>, advance<float, false, true>},
     {advance<float, true, false>, advance<float, true, true>}},
    {{advance<double, false, false>, advance<double, false, true>},
     {advance<double, true, false>, advance<double, true, true>}}};

}  // namespace cuticle::sim::rod
