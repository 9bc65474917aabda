// Substeps of blocks of strands for one instruction set: compiled several times (CMakeLists.txt) with CUTICLE_BATCH.
#include <cuticle/sim/detail/chain_lanes.h>
#include <cuticle/sim/exact/kernel.h>

namespace cuticle::sim::exact {
namespace {

using namespace detail;

/// Rows of a vertex's predicted place: that of the substep's begin, which is not needed once `before` has it, but
/// beside spheres.
template <bool Touches, class Real>
[[gnu::always_inline]] inline Real* predicted(const VertexRows<Real>& v) {
  if constexpr (Touches) return v.scratch_at(scratch_row::place);
  return v.state_at(state_row::here);
}

/// Tip to root: the scheme's prediction, and the lagged tensions' elimination.
template <class Real, bool Pulls, bool Touches>
[[gnu::always_inline]] inline void predict(const VertexRows<Real>& v, const ChainStep<Real>& step,
                                           StrandRows<Real>& rows) {
  const ChainStep<Real> s = step;
  each_lane([&](int lane) CUTICLE_INLINED {
    const ChainVertex<Real> vertex = chain_vertex(v, lane);
    const StrandStep<Real> strand = step_at(rows, lane);
    const glm::vec<3, Real> from = scheme_from(vertex, strand), coast = coasted(vertex, strand);
    Displacement<Real> d;
    if constexpr (Pulls) {
      const glm::vec<3, Real> rest = vector_at(v.rest_at(rest_row::target), lane), target = turned_to_end(s, rest);
      d = pulled_displacement(s, strand, coast, v.rest_at(rest_row::pull)[lane], target - from,
                              target - turned_to_begin(s, rest) + strand.root_step);
      v.scratch_at(scratch_row::inverse_mass)[lane] = v.rest_at(rest_row::inverse_mass)[lane] / d.inertia;
    } else {
      d = free_displacement(s, strand, coast);
      v.scratch_at(scratch_row::inverse_mass)[lane] = v.rest_at(rest_row::inverse_mass)[lane];
    }
    TensionCarry<Real> carry;
    const Led<Real> place =
        led(from + d.moved, v.rest_at(rest_row::mass)[lane] * d.inertia,
            v.state_at(state_row::tension)[lane] * (strand.time * strand.time), tension_carry_at(rows, lane), carry);
    put(rows.sum, lane, carry.sum);
    rows.stiffness[lane] = carry.stiffness;
    rows.tension_pivot[lane] = carry.inverse_pivot;
    put(v.state_at(state_row::before), lane, vertex.here - strand.root_step);
    put(v.state_at(state_row::velocity_before), lane, vertex.velocity);
    put(v.state_at(state_row::velocity), lane, from);  // until the velocity is known
    put(predicted<Touches>(v), lane, place.place);
    v.scratch_at(scratch_row::value)[lane] = place.follows;  // until the multiplier is known
  });
}

/// Root to tip: where the tensions let a vertex be.
template <class Real>
[[gnu::always_inline]] inline void lead(const VertexRows<Real>& v, const CarryRows<Real>& parent) {
  each_lane([&](int lane) CUTICLE_INLINED {
    Real* const place = predicted<true>(v);
    put(place, lane,
        within_reach(vector_at(place, lane) + vector_at(parent.place, lane) * v.scratch_at(scratch_row::value)[lane],
                     v.rest_at(rest_row::reach)[lane]));
  });
}

/// What both ways of elimination do once a vertex has its place.
template <class Real, bool Touches>
[[gnu::always_inline]] inline void eliminate_lane(const VertexRows<Real>& v, int lane, const LinkCarry<Real>& parent,
                                                  const glm::vec<3, Real>& place, const glm::vec<3, Real>& direction,
                                                  CarryRows<Real>& carry) {
  glm::vec<3, Real> normal(0);
  if constexpr (Touches) normal = vector_at(v.scratch_at(scratch_row::normal), lane);
  LinkRow<Real> row;
  put_carry(carry, lane,
            eliminated(parent, place, direction, normal, v.scratch_at(scratch_row::inverse_mass)[lane],
                       v.rest_at(rest_row::length)[lane], row));
  put(predicted<Touches>(v), lane, place);
  put(v.scratch_at(scratch_row::direction), lane, direction);
  v.scratch_at(scratch_row::coupling)[lane] = row.coupling;
  v.scratch_at(scratch_row::value)[lane] = row.value;
}

/// Where the link to a vertex predicted at `place` points.
template <class Real>
[[gnu::always_inline]] inline glm::vec<3, Real> link_direction(const VertexRows<Real>& v, const VertexRows<Real>& above,
                                                               int lane, const glm::vec<3, Real>& link) {
  const glm::vec<3, Real> before =
      (vector_at(v.state_at(state_row::before), lane) - vector_at(above.state_at(state_row::before), lane)) *
      v.rest_at(rest_row::inverse_length)[lane];
  return direction_or(link, Real(1e-3) * v.rest_at(rest_row::length)[lane], before);
}

/// A vertex that has its place; beside spheres it was within reach before they pushed it out.
template <class Real, bool Touches>
[[gnu::always_inline]] inline void eliminate(const VertexRows<Real>& v, const VertexRows<Real>& above,
                                             const glm::vec<3, Real>& side, const CarryRows<Real>& parent,
                                             CarryRows<Real>& carry) {
  const glm::vec<3, Real> to_side = side;
  each_lane([&](int lane) CUTICLE_INLINED {
    const LinkCarry<Real> from = carry_at(parent, lane);
    glm::vec<3, Real> here = vector_at(predicted<Touches>(v), lane);
    if constexpr (!Touches) here = within_reach(here, v.rest_at(rest_row::reach)[lane]);
    const glm::vec<3, Real> direction = link_direction(v, above, lane, here - from.place),
                            place = fold_opened(here, from, direction, v.rest_at(rest_row::length)[lane], to_side);
    eliminate_lane<Real, Touches>(v, lane, from, place, direction, carry);
  });
}

template <class Real>
[[gnu::always_inline]] inline int lead_and_eliminate_lane(const VertexRows<Real>& v, const VertexRows<Real>& above,
                                                          int lane, const CarryRows<Real>& parent,
                                                          CarryRows<Real>& carry) {
  const LinkCarry<Real> from = carry_at(parent, lane);
  const glm::vec<3, Real> place = vector_at(predicted<false>(v), lane) +
                                  from.place * v.scratch_at(scratch_row::value)[lane],
                          direction = link_direction(v, above, lane, place - from.place);
  eliminate_lane<Real, false>(v, lane, from, place, direction, carry);
  return is_far(place, v.rest_at(rest_row::reach)[lane]) || is_folded(direction, from) ? 1 : 0;
}

/// The same for a vertex that the tensions lead, as if it were within reach and its link not folded back: no lane waits
/// for two square roots of its parent. Whether a lane is otherwise.
template <class Real>
[[gnu::always_inline]] inline bool lead_and_eliminate(const VertexRows<Real>& v, const VertexRows<Real>& above,
                                                      const CarryRows<Real>& parent, CarryRows<Real>& carry) {
  int others = 0;
#pragma omp simd reduction(| : others)
  for (int lane = 0; lane < W; ++lane) others |= lead_and_eliminate_lane(v, above, lane, parent, carry);
  return others != 0;
}

template <class Real>
[[gnu::always_inline]] inline void substitute(const VertexRows<Real>& v, const VertexRows<Real>& below) {
  each_lane([&](int lane) CUTICLE_INLINED {
    v.scratch_at(scratch_row::value)[lane] =
        multiplier(v.scratch_at(scratch_row::value)[lane], below.scratch_at(scratch_row::coupling)[lane],
                   below.scratch_at(scratch_row::value)[lane]);
  });
}

/// The Newton step of a vertex, and where its link points from the parent's final place.
template <class Real, bool Touches>
[[gnu::always_inline]] inline void aim(const VertexRows<Real>& v, const VertexRows<Real>& parent,
                                       const VertexRows<Real>& below, StrandRows<Real>& rows) {
  each_lane([&](int lane) CUTICLE_INLINED {
    const glm::vec<3, Real> direction = vector_at(v.scratch_at(scratch_row::direction), lane);
    const glm::vec<3, Real> above = direction * v.scratch_at(scratch_row::value)[lane];
    const glm::vec<3, Real> under =
        vector_at(below.scratch_at(scratch_row::direction), lane) * below.scratch_at(scratch_row::value)[lane];
    glm::vec<3, Real> normal(0);
    if constexpr (Touches) normal = vector_at(v.scratch_at(scratch_row::normal), lane);
    const glm::vec<3, Real> place = newton_place(vector_at(predicted<Touches>(v), lane), normal,
                                                 v.scratch_at(scratch_row::inverse_mass)[lane], above, under);
    v.state_at(state_row::tension)[lane] =
        next_tension(v.state_at(state_row::tension)[lane], v.scratch_at(scratch_row::value)[lane],
                     v.rest_at(rest_row::inverse_length)[lane], rows.inverse_time[lane]);
    aim_lane(v, parent, lane, place, direction, rows);
  });
}

template <class Real, bool Pulls, bool Touches>
void substep(const ChainBlock<Real>& block, const ChainFrame<Real>& frame, const ChainStep<Real>& step,
             StrandRows<Real>& rows) {
  const auto vertex = [&](int i) { return VertexRows<Real>(block, i); };
  begin(block, step, rows);
  if constexpr (Touches) place_spheres(block, step, frame);
  for (int i = block.links; i >= 1; --i) predict<Real, Pulls, Touches>(vertex(i), step, rows);
  for (int i = 1; i <= block.links; ++i) {
    const CarryRows<Real>& parent = rows.carry[(i - 1) % 2];
    CarryRows<Real>& carry = rows.carry[i % 2];
    if constexpr (Touches) {
      lead(vertex(i), parent);
      push_out_of_all(frame, step, vertex(i));
    } else if (!lead_and_eliminate(vertex(i), vertex(i - 1), parent, carry)) {
      continue;
    }
    eliminate<Real, Touches>(vertex(i), vertex(i - 1), i % 2 ? step.end_x : step.end_y, parent, carry);
  }
  for (int i = block.links; i >= 1; --i) substitute(vertex(i), vertex(i + 1));
  follow_all<Real, Touches>(block, frame, step, rows,
                            [&](int i) { aim<Real, Touches>(vertex(i), vertex(i - 1), vertex(i + 1), rows); });
}

template <class Real, bool Pulls, bool Touches>
void advance(const ChainBlock<Real>& block, const ChainFrame<Real>& frame) {
  advance_parts(block, frame, [&](const ChainBlock<Real>& part, const ChainStep<Real>& step, StrandRows<Real>& rows) {
    substep<Real, Pulls, Touches>(part, frame, step, rows);
  });
}

}  // namespace

extern const Kernels CUTICLE_JOIN(kernels_, CUTICLE_BATCH_SET);
const Kernels CUTICLE_JOIN(kernels_, CUTICLE_BATCH_SET) = {{{advance<float, false, false>, advance<float, false, true>},
                                                            {advance<float, true, false>, advance<float, true, true>}},
                                                           advance<double, true, true>};

}  // namespace cuticle::sim::exact
