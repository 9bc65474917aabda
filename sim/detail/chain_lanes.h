#pragma once
// What the solvers of rigid links do with all lanes of a block, for their units of one instruction set: those are
// compiled several times with CUTICLE_BATCH, and no symbol may leave them, hence the unnamed namespace. Every loop over
// lanes is one block of arithmetic without calls or branches, which the compiler turns into vectors.
#include <cuticle/core/flush_to_zero.h>
#include <cuticle/sim/detail/chain_rows.h>

#define CUTICLE_JOIN_NAMES(a, b) a##b
#define CUTICLE_JOIN(a, b) CUTICLE_JOIN_NAMES(a, b)

namespace cuticle::sim::detail {
namespace {

constexpr int S = k_lanes;  ///< from row to row
/// Lanes that a pass takes at once: as many floats as a register holds, so that it is straight code; a block is walked
/// in so many parts.
#if defined(__AVX512F__)
constexpr int W = 16;
#elif defined(__AVX2__)
constexpr int W = 8;
#else
constexpr int W = 4;
#endif

// A loop whose body is a function of its own, inlined: locals of a loop would become arrays, which no vector holds.
#define CUTICLE_INLINED __attribute__((always_inline))
template <class Body>
[[gnu::always_inline]] inline void each_lane(const Body& body) {
#pragma omp simd
  for (int lane = 0; lane < W; ++lane) body(lane);
}

FN glm::vec<3, Real> vector_at(const Real* row, int lane) { return {row[lane], row[S + lane], row[2 * S + lane]}; }
FN void put(Real* row, int lane, const glm::vec<3, Real>& v) {
  row[lane] = v.x;
  row[S + lane] = v.y;
  row[2 * S + lane] = v.z;
}

/// LinkCarry.
template <class Real>
struct CarryRows {
  Real place[3 * S], direction[3 * S], normal[3 * S], inverse_mass[S], inverse_pivot[S], residual[S];
};

/// What a block's strands share with their links within a substep, a row for each number.
template <class Real>
struct StrandRows {
  Real root_step[3 * S], history[S], time[S], inverse_time[S], coasting[S], excess[S];
  CarryRows<Real> carry[2];                         ///< of links of even and of odd number
  Real sum[3 * S], stiffness[S], tension_pivot[S];  ///< TensionCarry
  Real newton[3 * S], newton_parent[3 * S], aim[3 * S], turned[3 * S], pushed[3 * S], free_parent[S];
};

FN StrandStep<Real> step_at(const StrandRows<Real>& rows, int lane) {
  return {vector_at(rows.root_step, lane), rows.history[lane], rows.time[lane], rows.inverse_time[lane],
          rows.coasting[lane]};
}
FN LinkCarry<Real> carry_at(const CarryRows<Real>& rows, int lane) {
  return {vector_at(rows.place, lane), vector_at(rows.direction, lane), vector_at(rows.normal, lane),
          rows.inverse_mass[lane],     rows.inverse_pivot[lane],        rows.residual[lane]};
}
FN TensionCarry<Real> tension_carry_at(const StrandRows<Real>& rows, int lane) {
  return {vector_at(rows.sum, lane), rows.stiffness[lane], rows.tension_pivot[lane]};
}
FN void put_carry(CarryRows<Real>& rows, int lane, const LinkCarry<Real>& carry) {
  put(rows.place, lane, carry.place);
  put(rows.direction, lane, carry.direction);
  put(rows.normal, lane, carry.normal);
  rows.inverse_mass[lane] = carry.inverse_mass;
  rows.inverse_pivot[lane] = carry.inverse_pivot;
  rows.residual[lane] = carry.residual;
}

/// Rows of vertex i.
template <class Real>
struct VertexRows {
  const Real* rest;
  Real *state, *scratch;
  VertexRows(const ChainBlock<Real>& block, int i)
      : rest(block.rest + i * rest_row::count * S),
        state(block.state + i * state_row::count * S),
        scratch(block.scratch + i * block.scratch_rows * S) {}
  const Real* rest_at(int row) const { return rest + row * S; }
  Real* state_at(int row) const { return state + row * S; }
  Real* scratch_at(int row) const { return scratch + row * S; }
};

template <class Real>
[[gnu::always_inline]] inline ChainVertex<Real> chain_vertex(const VertexRows<Real>& v, int lane) {
  return {vector_at(v.state_at(state_row::here), lane), vector_at(v.state_at(state_row::before), lane),
          vector_at(v.state_at(state_row::velocity), lane), vector_at(v.state_at(state_row::velocity_before), lane)};
}

template <class Real>
[[gnu::always_inline]] inline void begin(const ChainBlock<Real>& block, const ChainStep<Real>& step,
                                         StrandRows<Real>& rows) {
  const ChainStep<Real> s = step;
  const Real *anchor = block.strand + strand_row::anchor * S, *guarded = block.strand + strand_row::guarded * S;
  const VertexRows<Real> root(block, 0);
  each_lane([&](int lane) CUTICLE_INLINED {
    const StrandStep<Real> strand = strand_step(s, vector_at(anchor, lane), guarded[lane]);
    put(rows.root_step, lane, strand.root_step);
    put(root.state_at(state_row::velocity), lane, strand.root_step * s.per_second);
    put(root.state_at(state_row::before), lane, -strand.root_step);
    rows.history[lane] = strand.history;
    rows.time[lane] = strand.time;
    rows.inverse_time[lane] = strand.inverse_time;
    rows.coasting[lane] = strand.coasting;
    rows.excess[lane] = 0;
    rows.free_parent[lane] = 0;
    put_carry(rows.carry[0], lane, at_anchor<Real>());
    const TensionCarry<Real> tip = below_tip<Real>();
    put(rows.sum, lane, tip.sum);
    rows.stiffness[lane] = tip.stiffness;
    rows.tension_pivot[lane] = tip.inverse_pivot;
    put(rows.newton_parent, lane, glm::vec<3, Real>(0));
    put(rows.pushed, lane, glm::vec<3, Real>(0));
  });
}

template <class Real>
[[gnu::always_inline]] inline void clear_touch(const VertexRows<Real>& v) {
  each_lane([&](int lane) CUTICLE_INLINED {
    put(v.scratch_at(scratch_row::normal), lane, glm::vec<3, Real>(0));
    put(v.scratch_at(scratch_row::begin_pushed), lane, glm::vec<3, Real>(0));
  });
}

FN LinkSphere<Real> sphere_at(const Real* rows, int lane) { return {vector_at(rows, lane), rows[3 * S + lane]}; }

template <class Real>
[[gnu::always_inline]] inline void place_spheres(const ChainBlock<Real>& block, const ChainStep<Real>& step,
                                                 const ChainFrame<Real>& frame) {
  const ChainStep<Real> s = step;
  const Real *anchor = block.strand + strand_row::anchor * S,
             *length = VertexRows<Real>(block, 1).rest_at(rest_row::length);
  for (int k = 0; k < frame.sphere_count; ++k) {
    const LinkSphere<Real> sphere = frame.spheres[k];
    Real* const rows = frame.sphere_rows + 4 * S * k;
    each_lane([&](int lane) CUTICLE_INLINED {
      const LinkSphere<Real> placed =
          link_sphere(s, sphere.centre, sphere.radius, vector_at(anchor, lane), length[lane]);
      put(rows, lane, placed.centre);
      rows[3 * S + lane] = placed.radius;
    });
  }
}

template <class Real>
[[gnu::always_inline]] inline void push_out(const VertexRows<Real>& v, const ChainStep<Real>& step,
                                            const Real* sphere) {
  const ChainStep<Real> s = step;
  each_lane([&](int lane) CUTICLE_INLINED {
    const glm::vec<3, Real> here = vector_at(v.state_at(state_row::here), lane);
    const Touch<Real> touch = pushed_from(Touch<Real>{vector_at(v.scratch_at(scratch_row::place), lane),
                                                      vector_at(v.scratch_at(scratch_row::normal), lane),
                                                      vector_at(v.scratch_at(scratch_row::begin_pushed), lane)},
                                          sphere_at(sphere, lane), carried_by_head(s, here),
                                          direction_or(here, Real(0), s.end_y), s.friction);
    put(v.scratch_at(scratch_row::place), lane, touch.place);
    put(v.scratch_at(scratch_row::normal), lane, touch.normal);
    put(v.scratch_at(scratch_row::begin_pushed), lane, touch.begin_pushed);
  });
}

/// Where the Newton step put a vertex, and where its link points from the parent's final place.
template <class Real>
[[gnu::always_inline]] inline void aim_lane(const VertexRows<Real>& v, const VertexRows<Real>& parent, int lane,
                                            const glm::vec<3, Real>& newton, const glm::vec<3, Real>& fallback,
                                            StrandRows<Real>& rows) {
  const Real length = v.rest_at(rest_row::length)[lane];
  rows.excess[lane] = max(rows.excess[lane], excess_of_newton(newton - vector_at(rows.newton_parent, lane), length));
  const glm::vec<3, Real> aimed =
      direction_or(newton - vector_at(parent.state_at(state_row::here), lane), Real(1e-3) * length, fallback);
  put(rows.newton, lane, newton);
  put(rows.newton_parent, lane, newton);
  put(rows.aim, lane, aimed);
  put(rows.turned, lane, aimed);
}

template <class Real>
[[gnu::always_inline]] inline void turn_out(const VertexRows<Real>& v, const VertexRows<Real>& parent,
                                            const ChainStep<Real>& step, const Real* sphere, StrandRows<Real>& rows) {
  const glm::vec<3, Real> side = step.end_x, other = step.end_y;
  each_lane([&](int lane) CUTICLE_INLINED {
    const LinkSphere<Real> met = sphere_at(sphere, lane);
    const glm::vec<3, Real> from = vector_at(parent.state_at(state_row::here), lane),
                            aimed = vector_at(rows.turned, lane);
    const Real length = v.rest_at(rest_row::length)[lane];
    const glm::vec<3, Real> turned = turned_out(from, aimed, length, met, side, other), moved = turned - aimed;
    const glm::vec<3, Real> outward = direction_or(from + turned * length - met.centre, Real(0), turned);
    put(v.scratch_at(scratch_row::normal), lane,
        either(inner(moved, moved) > 0, outward, vector_at(v.scratch_at(scratch_row::normal), lane)));
    put(rows.turned, lane, turned);
  });
}

/// The link at its length, the velocities, and the share of the clean-up that the parent's velocity gives back.
template <class Real>
[[gnu::always_inline]] inline void follow(const VertexRows<Real>& v, const VertexRows<Real>& parent,
                                          StrandRows<Real>& rows) {
  each_lane([&](int lane) CUTICLE_INLINED {
    const Real length = v.rest_at(rest_row::length)[lane], inverse_time = rows.inverse_time[lane];
    const glm::vec<3, Real> place =
        vector_at(parent.state_at(state_row::here), lane) + vector_at(rows.aim, lane) * length;
    const glm::vec<3, Real> pull =
        cleanup_pull(place - vector_at(rows.newton, lane), length, v.rest_at(rest_row::mass_ratio)[lane], inverse_time);
    put(parent.state_at(state_row::velocity), lane, vector_at(parent.state_at(state_row::velocity), lane) - pull);
    put(v.state_at(state_row::velocity), lane,
        (place - vector_at(v.state_at(state_row::velocity), lane)) * inverse_time);
    put(v.state_at(state_row::here), lane, place);
  });
}

/// The same beside spheres. What a contact moved says nothing of the pull on the parent, and a parent in contact feels
/// none.
template <class Real>
[[gnu::always_inline]] inline void follow_beside(const VertexRows<Real>& v, const VertexRows<Real>& parent,
                                                 const ChainStep<Real>& step, StrandRows<Real>& rows) {
  const ChainStep<Real> s = step;
  each_lane([&](int lane) CUTICLE_INLINED {
    const Real length = v.rest_at(rest_row::length)[lane], inverse_time = rows.inverse_time[lane];
    const glm::vec<3, Real> from = vector_at(parent.state_at(state_row::here), lane),
                            normal = vector_at(v.scratch_at(scratch_row::normal), lane);
    const glm::vec<3, Real> aimed = from + vector_at(rows.aim, lane) * length,
                            place = from + vector_at(rows.turned, lane) * length;
    const glm::vec<3, Real> pushed = pushed_along(vector_at(rows.pushed, lane), vector_at(rows.aim, lane)),
                            turn = place - aimed;
    const glm::vec<3, Real> pull = cleanup_pull(aimed - vector_at(rows.newton, lane) - pushed, length,
                                                v.rest_at(rest_row::mass_ratio)[lane], inverse_time);
    put(parent.state_at(state_row::velocity), lane,
        vector_at(parent.state_at(state_row::velocity), lane) - pull * rows.free_parent[lane]);
    const bool touches = inner(normal, normal) > 0;
    const glm::vec<3, Real> begin = vector_at(v.state_at(state_row::before), lane);
    const Touch<Real> touch{place, normal, vector_at(v.scratch_at(scratch_row::begin_pushed), lane)};
    const glm::vec<3, Real> beside =
        touching_velocity(place, begin, carried_by_head(s, begin + vector_at(rows.root_step, lane)), touch,
                          sqrt(inner(turn, turn)), s.friction, s.per_second);
    const glm::vec<3, Real> free = (place - vector_at(v.state_at(state_row::velocity), lane)) * inverse_time;
    put(v.state_at(state_row::velocity), lane, either(touches, beside, free));
    put(v.state_at(state_row::here), lane, place);
    put(rows.pushed, lane, pushed + turn);
    rows.free_parent[lane] = touches ? Real(0) : Real(1);
    rows.excess[lane] = touches ? Real(1) : rows.excess[lane];
  });
}

/// All links down from the anchor: `aim(i)` has the Newton step of vertex i ready in `rows`.
template <class Real, bool Touches, class Aim>
void follow_all(const ChainBlock<Real>& block, const ChainFrame<Real>& frame, const ChainStep<Real>& step,
                StrandRows<Real>& rows, const Aim& aim) {
  const auto vertex = [&](int i) { return VertexRows<Real>(block, i); };
  for (int i = 1; i <= block.links; ++i) {
    aim(i);
    if constexpr (Touches) {
      for (int k = 0; k < frame.sphere_count; ++k)
        turn_out(vertex(i), vertex(i - 1), step, frame.sphere_rows + 4 * S * k, rows);
      follow_beside(vertex(i), vertex(i - 1), step, rows);
    } else {
      follow(vertex(i), vertex(i - 1), rows);
    }
  }
  each_lane([&](int lane) CUTICLE_INLINED {
    block.strand[strand_row::guarded * S + lane] = rows.excess[lane] > 0 ? Real(1) : Real(0);
  });
}

/// All substeps of a frame, part by part.
template <class Real, class Substep>
void advance_parts(const ChainBlock<Real>& block, const ChainFrame<Real>& frame, const Substep& substep) {
  [[maybe_unused]] const FlushToZero guard;
  StrandRows<Real> rows;
  for (int first = 0; first < S; first += W) {
    ChainBlock<Real> part = block;
    part.rest += first;
    part.state += first;
    part.strand += first;
    part.own += block.own ? first : 0;
    for (int k = 0; k < frame.count; ++k) substep(part, frame.steps[k], rows);
  }
}

template <class Real>
void push_out_of_all(const ChainFrame<Real>& frame, const ChainStep<Real>& step, const VertexRows<Real>& v) {
  clear_touch(v);
  for (int k = 0; k < frame.sphere_count; ++k) push_out(v, step, frame.sphere_rows + 4 * S * k);
}

}  // namespace
}  // namespace cuticle::sim::detail
