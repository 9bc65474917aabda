#pragma once
// What the solvers of rigid links do with all lanes of a block, for their units of one instruction set: those are
// compiled several times with CUTICLE_BATCH, and no symbol may leave them, hence the unnamed namespace. `Real` is a
// pack of as many strands' numbers as a register holds; a block is walked in so many parts.
#include <cuticle/core/flush_to_zero.h>
#include <cuticle/sim/detail/chain_rows.h>
#include <cuticle/sim/detail/pack.h>

#define CUTICLE_JOIN_NAMES(a, b) a##b
#define CUTICLE_JOIN(a, b) CUTICLE_JOIN_NAMES(a, b)

namespace cuticle::sim::detail {
namespace {

constexpr int S = k_lanes;  ///< from row to row

template <class Real>
using Vector = glm::vec<3, Real>;

template <class Real>
[[gnu::always_inline]] inline Real number_at(const typename Real::Scalar* row) {
  Real pack;
  std::memcpy(&pack.all, row, sizeof pack.all);
  return pack;
}
template <class Real, int Stride = S>
[[gnu::always_inline]] inline Vector<Real> vector_at(const typename Real::Scalar* row) {
  return {number_at<Real>(row), number_at<Real>(row + Stride), number_at<Real>(row + 2 * Stride)};
}
template <class Real, int Stride = S>
[[gnu::always_inline]] inline void put(typename Real::Scalar* row, Real number) {
  std::memcpy(row, &number.all, sizeof number.all);
}
template <class Real, int Stride = S>
[[gnu::always_inline]] inline void put(typename Real::Scalar* row, const Vector<Real>& v) {
  put<Real>(row, v.x);
  put<Real>(row + Stride, v.y);
  put<Real>(row + 2 * Stride, v.z);
}

/// Rows of vertex i. Those of the scratch are no longer than a register, so that more of them stay near.
template <class Real>
struct VertexRows {
  using Scalar = typename Real::Scalar;
  const Scalar* rest;
  Scalar *state, *scratch;
  [[gnu::always_inline]] VertexRows(const ChainBlock<Scalar>& block, int i)
      : rest(block.rest + i * rest_row::count * S),
        state(block.state + i * state_row::count * S),
        scratch(block.scratch + i * block.scratch_rows * Real::count) {}
  [[gnu::always_inline]] Real rest_at(int row) const { return number_at<Real>(rest + row * S); }
  [[gnu::always_inline]] Real state_at(int row) const { return number_at<Real>(state + row * S); }
  [[gnu::always_inline]] Real scratch_at(int row) const { return number_at<Real>(scratch + row * Real::count); }
  [[gnu::always_inline]] Vector<Real> rest_vector(int row) const { return vector_at<Real>(rest + row * S); }
  [[gnu::always_inline]] Vector<Real> state_vector(int row) const { return vector_at<Real>(state + row * S); }
  [[gnu::always_inline]] Vector<Real> scratch_vector(int row) const {
    return vector_at<Real, Real::count>(scratch + row * Real::count);
  }
  template <class T>
  [[gnu::always_inline]] void put_state(int row, const T& value) const {
    put<Real>(state + row * S, value);
  }
  template <class T>
  [[gnu::always_inline]] void put_scratch(int row, const T& value) const {
    put<Real, Real::count>(scratch + row * Real::count, value);
  }
};

template <class Real>
[[gnu::always_inline]] inline ChainVertex<Real> chain_vertex(const VertexRows<Real>& v) {
  return {v.state_vector(state_row::here), v.state_vector(state_row::before), v.state_vector(state_row::velocity),
          v.state_vector(state_row::velocity_before)};
}

/// The state before the substep is kept, and `from` where the velocity will be.
template <class Real>
[[gnu::always_inline]] inline void keep_before(const VertexRows<Real>& v, const ChainVertex<Real>& vertex,
                                               const StrandStep<Real>& strand, const Vector<Real>& from) {
  v.put_state(state_row::before, vertex.here - strand.root_step);
  v.put_state(state_row::velocity_before, vertex.velocity);
  v.put_state(state_row::velocity, from);
}

template <class Real, class Scalar>
[[gnu::always_inline]] inline StrandStep<Real> begin(const ChainBlock<Scalar>& block, const ChainStep<Real>& step) {
  const StrandStep<Real> strand = strand_step(step, vector_at<Real>(block.strand + strand_row::anchor * S),
                                              number_at<Real>(block.strand + strand_row::guarded * S));
  VertexRows<Real>(block, 0).put_state(state_row::before, -strand.root_step);
  return strand;
}

template <class Real>
[[gnu::always_inline]] inline LinkSphere<Real> sphere_at(const typename Real::Scalar* rows) {
  return {vector_at<Real>(rows), number_at<Real>(rows + 3 * S)};
}

/// The same for all strands.
template <class Real, template <class> class Numbers>
[[gnu::always_inline]] inline Numbers<Real> spread(const Numbers<typename Real::Scalar>& narrow) {
  constexpr std::size_t count = sizeof narrow / sizeof(typename Real::Scalar);
  static_assert(sizeof(Numbers<Real>) == count * sizeof(Real));
  typename Real::Scalar numbers[count];
  std::memcpy(numbers, &narrow, sizeof narrow);
  Real packs[count];
  for (std::size_t k = 0; k < count; ++k) packs[k] = numbers[k];
  Numbers<Real> wide;
  std::memcpy(static_cast<void*>(&wide), packs, sizeof wide);
  return wide;
}

template <class Real>
[[gnu::always_inline]] inline void put_sphere(typename Real::Scalar* rows, const Vector<Real>& centre, Real radius) {
  put<Real>(rows, centre);
  put<Real>(rows + 3 * S, radius);
}

/// Spheres, and of boxes and fields what differs from strand to strand.
template <class Real, class Scalar>
[[gnu::always_inline]] inline void place_colliders(const ChainBlock<Scalar>& block, const ChainStep<Real>& step,
                                                   const ChainFrame<Scalar>& frame) {
  const Vector<Real> anchor = vector_at<Real>(block.strand + strand_row::anchor * S);
  const Real first_link = VertexRows<Real>(block, 1).rest_at(rest_row::length);
  for (int k = 0; k < frame.sphere_count; ++k) {
    const LinkSphere<Real> sphere = spread<Real>(frame.spheres[k]);
    const LinkSphere<Real> placed = link_sphere(step, sphere.centre, sphere.radius, anchor, first_link);
    put_sphere(frame.collider_rows + 4 * S * k, placed.centre, placed.radius);
  }
  for (int k = 0; k < frame.box_count; ++k) {
    const LinkBox<Real> placed = link_box(step, spread<Real>(frame.boxes[k]), anchor, first_link);
    put_sphere(frame.collider_rows + 4 * S * (frame.sphere_count + k), placed.centre, placed.radius);
  }
  for (int k = 0; k < frame.field_count; ++k) {
    const LinkBox<Real> placed =
        link_field(step, spread<Real>(frame.fields[k]), frame.field_values[k], anchor, first_link).grid;
    put_sphere(frame.collider_rows + 4 * S * (frame.sphere_count + frame.box_count + k), placed.centre, placed.radius);
  }
}

template <class Real, class Scalar>
[[gnu::always_inline]] inline LinkSphere<Real> placed_at(const ChainFrame<Scalar>& frame, int k) {
  return sphere_at<Real>(frame.collider_rows + 4 * S * k);
}
/// One lane after the other: their cells lie apart.
template <class Number, int N>
[[gnu::noinline]] FieldSample<Pack<Number, N>> trilinear(const float* values, const Vector<Pack<Number, N>>& place,
                                                         const Vector<Pack<Number, N>>& cells) {
  FieldSample<Pack<Number, N>> samples;
  for (int k = 0; k < N; ++k) {
    const FieldSample<Number> one = sim::trilinear<Number>(values, {place.x.all[k], place.y.all[k], place.z.all[k]},
                                                           {cells.x.all[k], cells.y.all[k], cells.z.all[k]});
    for (int c = 0; c < 3; ++c) samples.slope[c].all[k] = one.slope[c];
    samples.distance.all[k] = one.distance;
  }
  return samples;
}

template <class Real, class Scalar>
[[gnu::always_inline]] inline LinkBox<Real> box_at(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                                   int k) {
  return turned_box(step, spread<Real>(frame.boxes[k]), placed_at<Real>(frame, frame.sphere_count + k));
}

// Not inlined, so that spheres alone keep their registers.
template <class Real, class Scalar>
[[gnu::noinline]] void push_from_boxes(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                       const Vector<Real>& carried, Touch<Real>& touch) {
  for (int k = 0; k < frame.box_count; ++k) {
    const LinkBox<Real> box = box_at(frame, step, k);
    const LinkSphere<Real> around = sphere_around(box);
    if (any(is_within(around, touch.place, Real(0)) || is_within(around, carried, Real(0))))
      touch = pushed_from(touch, inside_box(box, touch.place), inside_box(box, carried), carried, step.friction);
  }
}

template <class Real, class Scalar>
[[gnu::always_inline]] inline LinkField<Real> field_at(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                                       int k) {
  return turned_field(step, spread<Real>(frame.fields[k]),
                      placed_at<Real>(frame, frame.sphere_count + frame.box_count + k));
}

template <class Real, class Scalar>
[[gnu::noinline]] void push_from_fields(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                        const Vector<Real>& carried, Touch<Real>& touch) {
  for (int k = 0; k < frame.field_count; ++k) {
    const LinkField<Real> field = field_at(frame, step, k);
    const LinkSphere<Real> around = sphere_around(field.grid);
    if (!any(is_within(around, touch.place, Real(0)) || is_within(around, carried, Real(0)))) continue;
    const float* const values = frame.field_values[k];
    touch = pushed_from(touch, inside_field(field, values, touch.place), inside_field(field, values, carried), carried,
                        step.friction);
  }
}

/// The predicted vertex, pushed out of all colliders.
template <class Real, class Scalar>
[[gnu::always_inline]] inline Touch<Real> pushed_from_all(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                                          const Vector<Real>& here, const Vector<Real>& place) {
  Touch<Real> touch{place, Vector<Real>(Real(0)), Vector<Real>(Real(0))};
  const Vector<Real> carried = carried_by_head(step, here);
  for (int k = 0; k < frame.sphere_count; ++k) {
    const LinkSphere<Real> sphere = placed_at<Real>(frame, k);
    if (!any(is_within(sphere, touch.place, Real(0)) || is_within(sphere, carried, Real(0)))) continue;
    const Vector<Real> fallback = direction_or(here, Real(0), step.end_y);
    touch = pushed_from(touch, inside_sphere(sphere, touch.place, fallback), inside_sphere(sphere, carried, fallback),
                        carried, step.friction);
  }
  if (frame.box_count) push_from_boxes(frame, step, carried, touch);
  if (frame.field_count) push_from_fields(frame, step, carried, touch);
  return touch;
}

template <class Real>
[[gnu::always_inline]] inline void keep_touch(const VertexRows<Real>& v, const Touch<Real>& touch) {
  v.put_scratch(scratch_row::place, touch.place);
  v.put_scratch(scratch_row::normal, touch.normal);
  v.put_scratch(scratch_row::begin_pushed, touch.begin_pushed);
}

/// Where the Newton step put a vertex; where its link points if that says nothing.
template <class Real>
struct NewtonPlace {
  Vector<Real> place, fallback;
};
/// What the way down carries from parent to child.
template <class Real>
struct Following {
  Vector<Real> newton, place, velocity, pushed;
  Real excess, free_parent;
};

/// The link at its length, the velocities, and the share of the clean-up that the parent's velocity gives back.
template <class Real>
[[gnu::always_inline]] inline void follow(const VertexRows<Real>& v, const VertexRows<Real>& parent,
                                          const StrandStep<Real>& strand, const Vector<Real>& newton,
                                          const Vector<Real>& aim, Following<Real>& f) {
  const Real length = v.rest_at(rest_row::length);
  const Vector<Real> place = f.place + aim * length;
  const Vector<Real> pull = cleanup_pull(place - newton, length, v.rest_at(rest_row::mass_ratio), strand.inverse_time);
  parent.put_state(state_row::velocity, f.velocity - pull);
  f.velocity = (place - v.state_vector(state_row::velocity)) * strand.inverse_time;
  f.place = place;
}

template <class Real, class Scalar>
[[gnu::noinline]] void turn_out_of_boxes(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                         const Vector<Real>& from, Real length, Vector<Real>& turned,
                                         Vector<Real>& normal) {
  for (int k = 0; k < frame.box_count; ++k) {
    const LinkBox<Real> box = box_at(frame, step, k);
    if (!any(is_within(sphere_around(box), from, length))) continue;
    const Turned<Real> out = turned_out_of_box(from, turned, length, box, step.end_x, step.end_y);
    normal = either(inner(out.normal, out.normal) > Real(0), out.normal, normal);
    turned = out.direction;
  }
}

template <class Real, class Scalar>
[[gnu::noinline]] void turn_out_of_fields(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                          const Vector<Real>& from, Real length, Vector<Real>& turned,
                                          Vector<Real>& normal) {
  for (int k = 0; k < frame.field_count; ++k) {
    const LinkField<Real> field = field_at(frame, step, k);
    const float* const values = frame.field_values[k];
    if (!any(is_within(sphere_around(field.grid), from, length)) ||
        !any(may_enter(field, values, from, turned * length, length)))
      continue;
    const Turned<Real> out = turned_out_of_field(from, turned, length, field, values, step.end_x, step.end_y);
    normal = either(inner(out.normal, out.normal) > Real(0), out.normal, normal);
    turned = out.direction;
  }
}

/// The link turned out of all colliders; `normal` becomes that of the last.
template <class Real, class Scalar>
[[gnu::always_inline]] inline Vector<Real> turned_out_of_all(const ChainFrame<Scalar>& frame,
                                                             const ChainStep<Real>& step, const Vector<Real>& from,
                                                             const Vector<Real>& aim, Real length,
                                                             Vector<Real>& normal) {
  Vector<Real> turned = aim;
  for (int k = 0; k < frame.sphere_count; ++k) {
    const LinkSphere<Real> sphere = placed_at<Real>(frame, k);
    if (!any(is_within(sphere, from, length))) continue;
    const Vector<Real> out = turned_out(from, turned, length, sphere, step.end_x, step.end_y), moved = out - turned;
    normal =
        either(inner(moved, moved) > Real(0), direction_or(from + out * length - sphere.centre, Real(0), out), normal);
    turned = out;
  }
  if (frame.box_count) turn_out_of_boxes(frame, step, from, length, turned, normal);
  if (frame.field_count) turn_out_of_fields(frame, step, from, length, turned, normal);
  return turned;
}

/// The same beside spheres. What a contact moved says nothing of the pull on the parent, and a parent in contact feels
/// none.
template <class Real, class Scalar>
[[gnu::always_inline]] inline void follow_beside(const VertexRows<Real>& v, const VertexRows<Real>& parent,
                                                 const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                                 const StrandStep<Real>& strand, const Vector<Real>& newton,
                                                 const Vector<Real>& aim, Following<Real>& f) {
  const Real length = v.rest_at(rest_row::length);
  Vector<Real> normal = v.scratch_vector(scratch_row::normal);
  const Vector<Real> turned = turned_out_of_all(frame, step, f.place, aim, length, normal),
                     aimed = f.place + aim * length, place = f.place + turned * length, turn = place - aimed,
                     pushed = pushed_along(f.pushed, aim);
  const Vector<Real> pull =
      cleanup_pull(aimed - newton - pushed, length, v.rest_at(rest_row::mass_ratio), strand.inverse_time);
  parent.put_state(state_row::velocity, f.velocity - pull * f.free_parent);
  const auto touches = inner(normal, normal) > Real(0);
  const Vector<Real> begin = v.state_vector(state_row::before);
  const Vector<Real> beside = touching_velocity(place, begin, carried_by_head(step, begin + strand.root_step),
                                                Touch<Real>{place, normal, v.scratch_vector(scratch_row::begin_pushed)},
                                                sqrt(inner(turn, turn)), step.friction, step.per_second);
  f.velocity = either(touches, beside, (place - v.state_vector(state_row::velocity)) * strand.inverse_time);
  f.place = place;
  f.pushed = pushed + turn;
  f.free_parent = selected(touches, Real(0), Real(1));
  f.excess = selected(touches, Real(1), f.excess);
}

/// All links down from the anchor: `newton_of(i)` is the NewtonPlace of vertex i.
template <bool Touches, class Real, class Scalar, class NewtonOf>
[[gnu::always_inline]] inline void follow_all(const ChainBlock<Scalar>& block, const ChainFrame<Scalar>& frame,
                                              const ChainStep<Real>& step, const StrandStep<Real>& strand,
                                              const NewtonOf& newton_of) {
  const Vector<Real> zero(Real(0));
  Following<Real> f{zero, zero, strand.root_step * step.per_second, zero, Real(0), Real(0)};
  for (int i = 1; i <= block.links; ++i) {
    const VertexRows<Real> v(block, i), parent(block, i - 1);
    const NewtonPlace<Real> newton = newton_of(i);
    const Real length = v.rest_at(rest_row::length);
    f.excess = max(f.excess, excess_of_newton(newton.place - f.newton, length));
    f.newton = newton.place;
    const Vector<Real> aim = direction_or(newton.place - f.place, Real(1e-3) * length, newton.fallback);
    if constexpr (Touches)
      follow_beside(v, parent, frame, step, strand, newton.place, aim, f);
    else
      follow(v, parent, strand, newton.place, aim, f);
    v.put_state(state_row::here, f.place);
  }
  VertexRows<Real>(block, block.links).put_state(state_row::velocity, f.velocity);
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

/// On a skin every strand has a head of its own.
template <class Real, class Scalar>
[[gnu::always_inline]] inline void turn_on_skin(ChainStep<Real>& step, const Scalar* turns, int k) {
  const Scalar *begin = turns + k * turn_row::count * S, *end = begin + turn_row::count * S;
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
      if (frame.turns) turn_on_skin(step, frame.turns + first, k);
      substep(part, step);
    }
  }
}

}  // namespace
}  // namespace cuticle::sim::detail
