// Substeps of blocks of strands for one instruction set: compiled several times (CMakeLists.txt) with CUTICLE_BATCH.
#include <cuticle/sim/detail/chain_lanes.h>
#include <cuticle/sim/exact/kernel.h>

namespace cuticle::sim::exact {
namespace {

using namespace detail;

/// Tip to root: the scheme's prediction, and the lagged tensions' elimination.
template <class Real, bool Pulls>
void predict(const VertexRows<Real> v, const ChainStep<Real>& step, StrandRows<Real>& rows) {
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
    put(v.scratch_at(scratch_row::place), lane, place.place);
    v.scratch_at(scratch_row::follows)[lane] = place.follows;
  });
}

/// Root to tip: where the tensions let a vertex be.
template <class Real>
void lead(const VertexRows<Real> v, const StrandRows<Real>& rows) {
  each_lane([&](int lane) CUTICLE_INLINED {
    put(v.scratch_at(scratch_row::place), lane,
        within_reach(vector_at(v.scratch_at(scratch_row::place), lane) +
                         vector_at(rows.place, lane) * v.scratch_at(scratch_row::follows)[lane],
                     v.rest_at(rest_row::reach)[lane]));
  });
}

template <class Real, bool Touches>
void eliminate(const VertexRows<Real> v, const VertexRows<Real> parent, const glm::vec<3, Real>& side,
               StrandRows<Real>& rows) {
  const glm::vec<3, Real> to_side = side;
  each_lane([&](int lane) CUTICLE_INLINED {
    const LinkCarry<Real> carry = carry_at(rows, lane);
    const Real length = v.rest_at(rest_row::length)[lane];
    const glm::vec<3, Real> before =
        (vector_at(v.state_at(state_row::here), lane) - vector_at(parent.state_at(state_row::here), lane)) *
        v.rest_at(rest_row::inverse_length)[lane];
    const glm::vec<3, Real> predicted = vector_at(v.scratch_at(scratch_row::place), lane);
    const Real smallest = Real(1e-3) * length;
    const glm::vec<3, Real> direction = direction_or(predicted - carry.place, smallest, before);
    const glm::vec<3, Real> place = fold_opened(predicted, carry, direction, length, to_side);
    glm::vec<3, Real> normal(0);
    if constexpr (Touches) normal = vector_at(v.scratch_at(scratch_row::normal), lane);
    LinkRow<Real> row;
    put_carry(rows, lane,
              eliminated(carry, place, direction, normal, v.scratch_at(scratch_row::inverse_mass)[lane], length, row));
    put(v.scratch_at(scratch_row::place), lane, place);
    put(v.scratch_at(scratch_row::direction), lane, direction);
    v.scratch_at(scratch_row::coupling)[lane] = row.coupling;
    v.scratch_at(scratch_row::value)[lane] = row.value;
  });
}

template <class Real>
void substitute(const VertexRows<Real> v, const VertexRows<Real> below) {
  each_lane([&](int lane) CUTICLE_INLINED {
    v.scratch_at(scratch_row::value)[lane] =
        multiplier(v.scratch_at(scratch_row::value)[lane], below.scratch_at(scratch_row::coupling)[lane],
                   below.scratch_at(scratch_row::value)[lane]);
  });
}

/// The Newton step of a vertex, and where its link points from the parent's final place.
template <class Real, bool Touches>
void aim(const VertexRows<Real> v, const VertexRows<Real> parent, const VertexRows<Real> below,
         StrandRows<Real>& rows) {
  each_lane([&](int lane) CUTICLE_INLINED {
    const glm::vec<3, Real> direction = vector_at(v.scratch_at(scratch_row::direction), lane);
    const glm::vec<3, Real> above = direction * v.scratch_at(scratch_row::value)[lane];
    const glm::vec<3, Real> under =
        vector_at(below.scratch_at(scratch_row::direction), lane) * below.scratch_at(scratch_row::value)[lane];
    glm::vec<3, Real> normal(0);
    if constexpr (Touches) normal = vector_at(v.scratch_at(scratch_row::normal), lane);
    const glm::vec<3, Real> place = newton_place(vector_at(v.scratch_at(scratch_row::place), lane), normal,
                                                 v.scratch_at(scratch_row::inverse_mass)[lane], above, under);
    v.state_at(state_row::tension)[lane] =
        next_tension(v.state_at(state_row::tension)[lane], v.scratch_at(scratch_row::value)[lane],
                     v.rest_at(rest_row::inverse_length)[lane], rows.time[lane]);
    aim_lane(v, parent, lane, place, direction, rows);
  });
}

template <class Real, bool Pulls, bool Touches>
void substep(const ChainBlock<Real>& block, const ChainFrame<Real>& frame, const ChainStep<Real>& step,
             StrandRows<Real>& rows) {
  const auto vertex = [&](int i) { return VertexRows<Real>(block, i); };
  begin(block, step, rows);
  if constexpr (Touches) place_spheres(block, step, frame);
  for (int i = block.links; i >= 1; --i) predict<Real, Pulls>(vertex(i), step, rows);
  for (int i = 1; i <= block.links; ++i) {
    lead(vertex(i), rows);
    if constexpr (Touches) push_out_of_all(frame, step, vertex(i));
    eliminate<Real, Touches>(vertex(i), vertex(i - 1), i % 2 ? step.end_x : step.end_y, rows);
  }
  for (int i = block.links; i >= 1; --i) substitute(vertex(i), vertex(i + 1));
  follow_all<Real, Touches>(block, frame, step, rows,
                            [&](int i) { aim<Real, Touches>(vertex(i), vertex(i - 1), vertex(i + 1), rows); });
}

template <class Real, bool Pulls, bool Touches>
void advance(const ChainBlock<Real>& block, const ChainFrame<Real>& frame) {
  [[maybe_unused]] const FlushToZero guard;
  StrandRows<Real> rows;
  for (int k = 0; k < frame.count; ++k) substep<Real, Pulls, Touches>(block, frame, frame.steps[k], rows);
}

}  // namespace

extern const Kernels CUTICLE_JOIN(kernels_, CUTICLE_BATCH_SET);
const Kernels CUTICLE_JOIN(kernels_, CUTICLE_BATCH_SET) = {{{advance<float, false, false>, advance<float, false, true>},
                                                            {advance<float, true, false>, advance<float, true, true>}},
                                                           advance<double, true, true>};

}  // namespace cuticle::sim::exact
