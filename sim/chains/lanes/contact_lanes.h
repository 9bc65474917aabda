#pragma once
// How all lanes of a block meet colliders, for the units of one instruction set (row_lanes.h).
#include "sim/chains/lanes/collider_lanes.h"

namespace cuticle::sim::chains {
namespace {

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
  const LinkSphere<Real> placed = placed_at<Real>(frame, frame.sphere_count + k);
  LinkBox<Real> box = spread<Real>(frame.boxes[k]);
  if (!frame.carries) return turned_box(step, box, placed);
  box.centre = placed.centre;
  box.radius = placed.radius;
  return box;
}

/// A predicted vertex and a collider that moves by itself.
template <class Real>
struct Meeting {
  Vector<Real> carried;  ///< where the collider takes the vertex' begin
  Real way;              ///< how far the vertex is from there
};
template <class Real, class Scalar>
[[gnu::always_inline]] inline Meeting<Real> meeting(const ChainFrame<Scalar>& frame, int k, const Vector<Real>& here,
                                                    const Vector<Real>& place) {
  const Vector<Real> carried =
                         turned_along(spread<Real>(frame.carries[k]), here) + vector_at<Real>(carry_rows(frame, k)),
                     way = place - carried;
  return {carried, sqrt(inner(way, way))};
}

template <class Real, class Scalar>
[[gnu::noinline]] void push_from_moving_boxes(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                              const Vector<Real>& here, Touch<Real>& touch) {
  for (int k = 0; k < frame.box_count; ++k) {
    const LinkBox<Real> box = box_at(frame, step, k);
    const auto [carried, way] = meeting(frame, k, here, touch.place);
    if (!any(is_within(sphere_around(box), touch.place, way))) continue;
    const Surface<Real> met =
        any(outruns(way, thickness_of(box))) ? met_on_box(box, carried, touch.place) : inside_box(box, touch.place);
    touch = pushed_from(touch, met, inside_box(box, carried), carried, step, Real(k + 1));
  }
}

// Not inlined, so that spheres alone keep their registers.
template <class Real, class Scalar>
[[gnu::noinline]] void push_from_boxes(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                       const Vector<Real>& carried, Touch<Real>& touch) {
  for (int k = 0; k < frame.box_count; ++k) {
    const LinkBox<Real> box = box_at(frame, step, k);
    const LinkSphere<Real> around = sphere_around(box);
    if (any(is_within(around, touch.place, Real(0)) || is_within(around, carried, Real(0))))
      touch = pushed_from(touch, inside_box(box, touch.place), inside_box(box, carried), carried, step, Real(0));
  }
}

template <class Real, class Scalar>
[[gnu::always_inline]] inline LinkField<Real> field_at(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                                       int k) {
  const LinkSphere<Real> placed = placed_at<Real>(frame, frame.sphere_count + frame.box_count + k);
  LinkField<Real> field = spread<Real>(frame.fields[k]);
  if (!frame.carries) return turned_field(step, field, placed);
  field.grid.centre = placed.centre;
  field.grid.radius = placed.radius;
  return field;
}

template <class Real, class Scalar>
[[gnu::noinline]] void push_from_moving_fields(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                               const Vector<Real>& here, Touch<Real>& touch) {
  for (int k = 0; k < frame.field_count; ++k) {
    const LinkField<Real> field = field_at(frame, step, k);
    const auto [carried, way] = meeting(frame, frame.box_count + k, here, touch.place);
    if (!any(is_within(sphere_around(field.grid), touch.place, way))) continue;
    const float* const values = frame.field_values[k];
    const Surface<Real> met = any(outruns(way, thickness_of(field))) ? met_on_field(field, values, carried, touch.place)
                                                                     : inside_field(field, values, touch.place);
    touch = pushed_from(touch, met, inside_field(field, values, carried), carried, step, Real(frame.box_count + k + 1));
  }
}

/// `carried` by the head, or by the collider that moves by itself and that the vertex touches.
template <class Real, class Scalar>
[[gnu::noinline]] Vector<Real> carried_by_moving(const ChainFrame<Scalar>& frame, const Vector<Real>& carried,
                                                 const Vector<Real>& here, Real touched) {
  Vector<Real> result = carried;
  for (int k = 0; k < frame.box_count + frame.field_count; ++k)
    result = carried_by_touched(result, spread<Real>(frame.carries[k]), vector_at<Real>(carry_rows(frame, k)), here,
                                touched, Real(k + 1));
  return result;
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
                        step, Real(0));
  }
}

/// The predicted vertex, pushed out of all colliders.
template <class Real, class Scalar>
[[gnu::always_inline]] inline Touch<Real> pushed_from_all(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                                          const Vector<Real>& here, const Vector<Real>& place) {
  Touch<Real> touch{place, Vector<Real>(Real(0)), Vector<Real>(Real(0)), Real(0)};
  const Vector<Real> carried = carried_by_head(step, here);
  for (int k = 0; k < frame.sphere_count; ++k) {
    const LinkSphere<Real> sphere = placed_at<Real>(frame, k);
    if (!any(is_within(sphere, touch.place, Real(0)) || is_within(sphere, carried, Real(0)))) continue;
    const Vector<Real> fallback = direction_or(here, Real(0), step.end_y);
    touch = pushed_from(touch, inside_sphere(sphere, touch.place, fallback), inside_sphere(sphere, carried, fallback),
                        carried, step, Real(0));
  }
  if (frame.carries) {
    push_from_moving_boxes(frame, step, here, touch);
    push_from_moving_fields(frame, step, here, touch);
    return touch;
  }
  if (frame.box_count) push_from_boxes(frame, step, carried, touch);
  if (frame.field_count) push_from_fields(frame, step, carried, touch);
  return touch;
}

template <class Real, class Scalar>
[[gnu::always_inline]] inline void keep_touch(const VertexRows<Real>& v, const ChainFrame<Scalar>& frame,
                                              const Touch<Real>& touch) {
  if (frame.carries) v.put_scratch(scratch_row::touched, touch.collider);
  v.put_scratch(scratch_row::place, touch.place);
  v.put_scratch(scratch_row::normal, touch.normal);
  v.put_scratch(scratch_row::second_normal, Vector<Real>(Real(0)));
  v.put_scratch(scratch_row::begin_pushed, touch.begin_pushed);
}

/// But for its place. `is_kept`: unless the prediction left it out.
template <class Real, class Scalar>
[[gnu::always_inline]] inline Touch<Real> kept_touch(const VertexRows<Real>& v, const ChainFrame<Scalar>& frame,
                                                     bool is_kept) {
  const Vector<Real> zero(Real(0));
  if (!is_kept) return {zero, zero, zero, Real(0)};
  return {zero, v.scratch_vector(scratch_row::normal), v.scratch_vector(scratch_row::begin_pushed),
          frame.carries ? v.scratch_at(scratch_row::touched) : Real(0)};
}

/// `here`: where the vertices begin, of parent and child.
template <class Real>
struct LinkBegin {
  Vector<Real> parent, child;
};
/// Not inlined: beside most colliders few links are.
template <class Real, class Scalar>
[[gnu::noinline]] void press(const Pressed<Real>& p, const ChainFrame<Scalar>& frame, const LinkBegin<Real>& here,
                             Real friction, Real number, PredictedLink<Real>& link) {
  if (!any(presses(link, p) || lies_over_edge(link, p))) return;
  Vector<Real> parent = link.parent_carried, child = link.child_carried;
  if (frame.carries) {
    parent = carried_by_moving(frame, parent, here.parent, number);
    child = carried_by_moving(frame, child, here.child, number);
  }
  link = pressed_out(link, p, parent, child, friction, number);
}

template <class Real, class Scalar>
[[gnu::noinline]] void press_on_boxes(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                      const LinkBegin<Real>& here, Real length, PredictedLink<Real>& link) {
  for (int k = 0; k < frame.box_count; ++k) {
    const LinkBox<Real> box = box_at(frame, step, k);
    if (!any(is_within(sphere_around(box), link.parent, length))) continue;
    press(pressed_on_box(box, link.parent, link.child - link.parent), frame, here, step.friction, Real(k + 1), link);
  }
}
template <class Real, class Scalar>
[[gnu::noinline]] void press_on_fields(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                       const LinkBegin<Real>& here, Real length, PredictedLink<Real>& link) {
  for (int k = 0; k < frame.field_count; ++k) {
    const LinkField<Real> field = field_at(frame, step, k);
    const float* const values = frame.field_values[k];
    const Vector<Real> way = link.child - link.parent;
    if (!any(is_within(sphere_around(field.grid), link.parent, length)) ||
        !any(may_enter(field, values, link.parent, way, length)))
      continue;
    press(pressed_on_field(field, values, link.parent, way), frame, here, step.friction, Real(frame.box_count + k + 1),
          link);
  }
}

/// The predicted link out of all colliders; `touch`: of its child, whose place it starts from.
template <class Real, class Scalar>
[[gnu::always_inline]] inline void press_on_all(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                                const LinkBegin<Real>& here, Real length, PredictedLink<Real>& link) {
  for (int k = 0; k < frame.sphere_count; ++k) {
    const LinkSphere<Real> sphere = placed_at<Real>(frame, k);
    if (any(is_within(sphere, link.parent, length)))
      press(pressed_on_sphere(sphere, link.parent, link.child - link.parent, step.end_y), frame, here, step.friction,
            Real(0), link);
  }
  if (frame.box_count) press_on_boxes(frame, step, here, length, link);
  if (frame.field_count) press_on_fields(frame, step, here, length, link);
}

/// A vertex at `touch` and the link above it, whose parent was predicted at `parent`, pressed out of all colliders and
/// kept in the scratch rows, but for places.
template <class Real, class Scalar>
[[gnu::always_inline]] inline PredictedLink<Real> pressed_from_all(
    const VertexRows<Real>& v, const VertexRows<Real>& above, const ChainFrame<Scalar>& frame,
    const ChainStep<Real>& step, const LinkBegin<Real>& here, const Vector<Real>& parent, Real follows,
    const Touch<Real>& touch, Real sharpest) {
  const Vector<Real> above_pushed = above.scratch_vector(scratch_row::begin_pushed);
  Real kept(0);
  if (any(inner(touch.begin_pushed, touch.begin_pushed) + inner(above_pushed, above_pushed) > Real(0)))
    kept = max(leaving_of(touch.begin_pushed, leaving(step)).kept, leaving_of(above_pushed, leaving(step)).kept);
  PredictedLink<Real> link{parent,
                           touch.place,
                           carried_by_head(step, here.parent),
                           carried_by_head(step, here.child),
                           above.scratch_vector(scratch_row::normal),
                           touch.normal,
                           above.scratch_vector(scratch_row::second_normal),
                           Vector<Real>(Real(0)),
                           v.rest_at(rest_row::mass_ratio),
                           follows,
                           kept,
                           touch.collider,
                           sharpest,
                           above.scratch_at(scratch_row::edge),
                           Real(0)};
  press_on_all(frame, step, here, v.rest_at(rest_row::length), link);
  above.put_scratch(scratch_row::normal, link.parent_normal);
  v.put_scratch(scratch_row::normal, link.child_normal);
  above.put_scratch(scratch_row::second_normal, link.parent_second);
  v.put_scratch(scratch_row::second_normal, link.child_second);
  v.put_scratch(scratch_row::edge, link.edge);
  if (frame.carries) v.put_scratch(scratch_row::touched, link.touched);
  return link;
}

/// Whether anything is kept of contacts of `link`, whose child was at `touch`.
template <class Real>
[[gnu::always_inline]] inline bool is_in_contact(const Touch<Real>& touch, const PredictedLink<Real>& link) {
  return any(inner(touch.begin_pushed, touch.begin_pushed) + inner(link.parent_normal, link.parent_normal) +
                 inner(link.child_normal, link.child_normal) + link.edge >
             Real(0));
}

/// `out`: out of the collider of this number.
template <class Real>
[[gnu::always_inline]] inline void take_turn(const Turned<Real>& out, Real number, Turned<Real>& turned,
                                             Real& touched) {
  const auto hits = inner(out.normal, out.normal) > Real(0);
  turned = {out.direction, either(hits, out.normal, turned.normal)};
  touched = selected(hits, number, touched);
}

template <class Real, class Scalar>
[[gnu::noinline]] void turn_out_of_boxes(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                         const Vector<Real>& from, Real length, Real kept, Turned<Real>& turned,
                                         Real& touched) {
  for (int k = 0; k < frame.box_count; ++k) {
    LinkBox<Real> box = box_at(frame, step, k);
    if (!any(is_within(sphere_around(box), from, length))) continue;
    box.radius = box.radius - kept;
    const Turned<Real> out = turned_out_of_box(from, turned.direction, length, box, step.end_x, step.end_y);
    take_turn(out, Real(k + 1), turned, touched);
  }
}

template <class Real, class Scalar>
[[gnu::noinline]] void turn_out_of_fields(const ChainFrame<Scalar>& frame, const ChainStep<Real>& step,
                                          const Vector<Real>& from, Real length, Real kept, Turned<Real>& turned,
                                          Real& touched) {
  for (int k = 0; k < frame.field_count; ++k) {
    LinkField<Real> field = field_at(frame, step, k);
    const float* const values = frame.field_values[k];
    if (!any(is_within(sphere_around(field.grid), from, length)) ||
        !any(may_enter(field, values, from, turned.direction * length, length)))
      continue;
    field.grid.radius = field.grid.radius - kept;
    const Turned<Real> out = turned_out_of_field(from, turned.direction, length, field, values, step.end_x, step.end_y);
    take_turn(out, Real(frame.box_count + k + 1), turned, touched);
  }
}

/// The link turned out of all colliders, but for a depth of `kept`; `normal` becomes that of the last, and `touched`
/// which it is.
template <class Real, class Scalar>
[[gnu::always_inline]] inline Vector<Real> turned_out_of_all(const ChainFrame<Scalar>& frame,
                                                             const ChainStep<Real>& step, const Vector<Real>& from,
                                                             const Vector<Real>& aim, Real length, Real kept,
                                                             Vector<Real>& normal, Real& touched) {
  Vector<Real> turned = aim;
  for (int k = 0; k < frame.sphere_count; ++k) {
    LinkSphere<Real> sphere = placed_at<Real>(frame, k);
    if (!any(is_within(sphere, from, length))) continue;
    sphere.radius = sphere.radius - kept;
    const Vector<Real> out = turned_out(from, turned, length, sphere, step.end_x, step.end_y), moved = out - turned;
    const auto hits = inner(moved, moved) > Real(0);
    normal = either(hits, normal_of_turned(sphere, from, out, length), normal);
    touched = selected(hits, Real(0), touched);
    turned = out;
  }
  Turned<Real> beside{turned, normal};
  if (frame.box_count) turn_out_of_boxes(frame, step, from, length, kept, beside, touched);
  if (frame.field_count) turn_out_of_fields(frame, step, from, length, kept, beside, touched);
  normal = beside.normal;
  return beside.direction;
}

}  // namespace
}  // namespace cuticle::sim::chains
