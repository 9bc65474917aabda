// Substeps of blocks of strands for one instruction set: compiled several times (CMakeLists.txt) with CUTICLE_BATCH.
#include <utility>

#include <cuticle/sim/detail/chain_lanes.h>
#include <cuticle/sim/rod/kernel.h>
#include <cuticle/sim/rod/rod_step.glslh>

namespace cuticle::sim::rod {
namespace {

using namespace detail;

#define ROWS Real*
#define UNROLLED
#define AT(rows, row) (rows)[(row)*k_lanes + lane]
#define BAND_BEGIN rod_row::band
#define RIGHT_BEGIN rod_row::right
#include "cuticle/sim/rod/rod_band.glslh"

FN Real* hinge_at(const ChainBlock<Real>& block, int i, int row) {
  return block.own + (i * hinge_row::count + row) * k_lanes;
}

template <class Real>
void coast(const ChainBlock<Real>& block, int i, const ChainStep<Real>& step, const StrandRows<Real>& rows) {
  const VertexRows<Real> v(block, i), parent(block, i - 1), tip(block, block.links);
  const ChainStep<Real> s = step;
  each_lane([&](int lane) CUTICLE_INLINED {
    const ChainVertex<Real> vertex = chain_vertex(v, lane);
    const StrandStep<Real> strand = step_at(rows, lane);
    const glm::vec<3, Real> from = scheme_from(vertex, strand), drift = coasted(vertex, strand);
    const Coast<Real> c = coast_of(vertex.here, from, drift, free_displacement(s, strand, drift).moved,
                                   fall_of(s, strand.time), tip.rest_at(rest_row::reach)[lane]);
    const Real length = v.rest_at(rest_row::length)[lane];
    const glm::vec<3, Real> before = (vertex.here - vector_at(parent.state_at(state_row::here), lane)) *
                                     v.rest_at(rest_row::inverse_length)[lane],
                            direction = direction_or(c.place - vector_at(parent.scratch_at(rod_row::coasted), lane),
                                                     Real(1e-3) * length, before);
    put(v.scratch_at(rod_row::coasted), lane, c.place);
    put(v.scratch_at(rod_row::coast), lane, vector_at(parent.scratch_at(rod_row::coast), lane) + direction * length);
    put(v.scratch_at(scratch_row::direction), lane, direction);
    put(v.scratch_at(scratch_row::place), lane, c.predicted);
    put(v.state_at(state_row::before), lane, vertex.here - strand.root_step);
    put(v.state_at(state_row::velocity_before), lane, vertex.velocity);
    put(v.state_at(state_row::velocity), lane, from);  // until the velocity is known
  });
}

/// The clamp's direction and director stand where a vertex has its own.
template <class Real>
void clamp(const ChainBlock<Real>& block, const ChainStep<Real>& step) {
  const VertexRows<Real> root(block, 0);
  const ChainStep<Real> s = step;
  const Real *direction = hinge_at(block, 0, hinge_row::direction), *director = hinge_at(block, 0, hinge_row::director);
  each_lane([&](int lane) CUTICLE_INLINED {
    put(root.scratch_at(scratch_row::direction), lane, turned_to_end(s, vector_at(direction, lane)));
    put(root.scratch_at(rod_row::director), lane, turned_to_end(s, vector_at(director, lane)));
  });
}

template <class Real>
void bend(const ChainBlock<Real>& block, int i) {
  const VertexRows<Real> v(block, i), parent(block, i - 1);
  const Real *angle = hinge_at(block, i, hinge_row::angle), *x = hinge_at(block, i, hinge_row::bend_x),
             *y = hinge_at(block, i, hinge_row::bend_y), *stiffness = hinge_at(block, i, hinge_row::stiffness);
  const Real* const parent_angle = hinge_at(block, i - 1, hinge_row::angle);
  each_lane([&](int lane) CUTICLE_INLINED {
    const glm::vec<3, Real> above = vector_at(parent.scratch_at(scratch_row::direction), lane),
                            here = vector_at(v.scratch_at(scratch_row::direction), lane),
                            director = vector_at(parent.scratch_at(rod_row::director), lane);
    const Hinge<Real> hinge = hinge_between(above, here, director, x[lane], y[lane],
                                            Real(0.5) * (sane_angle(parent_angle[lane]) + sane_angle(angle[lane])));
    put(v.scratch_at(rod_row::director), lane, transported(director, above, here));
    put(v.scratch_at(rod_row::natural), lane, hinge.natural);
    put(v.scratch_at(rod_row::natural_spin), lane, hinge.natural_spin);
    v.scratch_at(rod_row::across)[lane] = hinge.across;
    v.scratch_at(rod_row::along)[lane] = hinge.along;
    v.scratch_at(rod_row::moment)[lane] = stiffness[lane] * spin_moment(hinge);
    v.scratch_at(rod_row::rounding)[lane] = stiffness[lane] * spin_stiffness(hinge);
  });
}

FN AngleHinge<Real> angle_hinge(const ChainBlock<Real>& block, int i, const Real* parent_angle, int lane) {
  const VertexRows<Real> v(block, i);
  const Real stiffness = hinge_at(block, i, hinge_row::twist)[lane];
  const Real turned = sane_angle(hinge_at(block, i, hinge_row::angle)[lane]) - sane_angle(parent_angle[lane]) -
                      hinge_at(block, i, hinge_row::natural_angle)[lane];
  return {stiffness, v.scratch_at(rod_row::moment)[lane], v.scratch_at(rod_row::rounding)[lane], stiffness * turned};
}

template <class Real>
void eliminate_angle(const ChainBlock<Real>& block, int i) {
  const VertexRows<Real> v(block, i), parent(block, i - 1);
  const Real *above = hinge_at(block, i - 1, hinge_row::angle), *here = hinge_at(block, i, hinge_row::angle);
  each_lane([&](int lane) CUTICLE_INLINED {
    const AngleRow<Real> row =
        angle_eliminated(angle_hinge(block, i, above, lane), angle_hinge(block, i + 1, here, lane),
                         AngleRow<Real>{parent.scratch_at(rod_row::angle_coupling)[lane],
                                        parent.scratch_at(rod_row::angle_value)[lane]});
    v.scratch_at(rod_row::angle_coupling)[lane] = row.coupling;
    v.scratch_at(rod_row::angle_value)[lane] = row.value;
  });
}

template <class Real>
void substitute_angle(const ChainBlock<Real>& block, int i) {
  const VertexRows<Real> v(block, i), below(block, i + 1);
  each_lane([&](int lane) CUTICLE_INLINED {
    v.scratch_at(rod_row::angle_value)[lane] =
        limited_turn(multiplier(v.scratch_at(rod_row::angle_value)[lane], v.scratch_at(rod_row::angle_coupling)[lane],
                                below.scratch_at(rod_row::angle_value)[lane]));
  });
}

/// The angles' step, and what bending pulls with the new ones.
template <class Real>
void pull(const ChainBlock<Real>& block, int i, const StrandRows<Real>& rows) {
  const VertexRows<Real> v(block, i), parent(block, i - 1);
  const Real *stiffness = hinge_at(block, i, hinge_row::stiffness), *twist = hinge_at(block, i, hinge_row::twist),
             *natural_angle = hinge_at(block, i, hinge_row::natural_angle),
             *parent_angle = hinge_at(block, i - 1, hinge_row::angle);  // already the new one
  Real* const angle = hinge_at(block, i, hinge_row::angle);
  each_lane([&](int lane) CUTICLE_INLINED {
    const Real turn = v.scratch_at(rod_row::angle_value)[lane], time = rows.time[lane];
    const Real above = parent.scratch_at(rod_row::angle_value)[lane];
    const glm::vec<3, Real> natural =
        spun(vector_at(v.scratch_at(rod_row::natural), lane), vector_at(v.scratch_at(rod_row::natural_spin), lane),
             Real(0.5) * (turn + above));
    const glm::vec<3, Real> here = vector_at(v.scratch_at(scratch_row::direction), lane),
                            parent_direction = vector_at(parent.scratch_at(scratch_row::direction), lane);
    const glm::vec<3, Real> chord = here - parent_direction;
    const Real across = v.scratch_at(rod_row::across)[lane], along = v.scratch_at(rod_row::along)[lane],
               weight = stiffness[lane] * (time * time);
    const Real now = sane_angle(angle[lane]) + turn, twist_weight = twist[lane] * (time * time);
    angle[lane] = now;
    put(v.scratch_at(rod_row::spin_pull), lane,
        spin_by(parent_direction, here) * (twist_weight * (now - parent_angle[lane] - natural_angle[lane])));
    put(v.scratch_at(rod_row::pull), lane, bending_pull(chord, across, along, natural) * weight);
    v.scratch_at(rod_row::gain)[lane] = weight * across * along;
    v.scratch_at(rod_row::spin)[lane] = twist_weight * (along * along - Real(1));
  });
}

FN HingeRow<Real> hinge_row_at(const ChainBlock<Real>& block, const VertexRows<Real>& v, int i, int lane) {
  return {vector_at(v.scratch_at(rod_row::pull), lane), vector_at(v.scratch_at(rod_row::spin_pull), lane),
          v.scratch_at(rod_row::gain)[lane], v.scratch_at(rod_row::spin)[lane],
          hinge_at(block, i, hinge_row::inverse_length)[lane]};
}

template <class Real, bool Touches>
void assemble(const ChainBlock<Real>& block, int i, const ChainStep<Real>& step, const StrandRows<Real>& rows) {
  const int end = block.links + 1,
            above = i > 1 ? i - 1 : end;  // nothing bends past the ends: rows of the end are zero
  const VertexRows<Real> v(block, i), child(block, i + 1), grandchild(block, i + 2 < end ? i + 2 : end);
  const Real* parent_inverse = hinge_at(block, above, hinge_row::inverse_length);
  const Real drag = step.drag;
  each_lane([&](int lane) CUTICLE_INLINED {
    const BendRow<Real> bends =
        bend_row(hinge_row_at(block, v, i, lane), hinge_row_at(block, child, i + 1, lane),
                 hinge_row_at(block, grandchild, i + 2 < end ? i + 2 : end, lane), parent_inverse[lane]);
    const Real time = rows.time[lane], mass = v.rest_at(rest_row::mass)[lane] * (Real(1) + drag * time);
    const Real taut = v.state_at(state_row::tension)[lane] * (time * time),
               taut_below = child.state_at(state_row::tension)[lane] * (time * time);
    const glm::vec<3, Real> wanted =
        vector_at(v.scratch_at(scratch_row::place), lane) - vector_at(v.scratch_at(rod_row::coast), lane);
    glm::vec<3, Real> contact(0);
    if constexpr (Touches) contact = vector_at(v.scratch_at(scratch_row::normal), lane) * sqrt(contact_weight(mass));
    put_rows(v.scratch, lane, mass + taut + taut_below + bends.diagonal, bends.beside - taut, bends.beyond,
             vector_at(v.scratch_at(scratch_row::direction), lane), contact,
             wanted * mass + contact * inner(contact, wanted) + bends.force);
  });
}

template <class Real, int C, int J>
void eliminate_one(Real* own, Real* parent, Real* grandparent) {
  each_lane([&](int lane) CUTICLE_INLINED { eliminate_entry(own, parent, grandparent, C, J, lane); });
}
template <class Real, int C>
void eliminate_row(Real* own, Real* parent, Real* grandparent) {
  [&]<int... J>(std::integer_sequence<int, J...>) { (eliminate_one<Real, C, 8 - J>(own, parent, grandparent), ...); }
  (std::make_integer_sequence<int, 8>());
  each_lane([&](int lane) CUTICLE_INLINED { eliminate_pivot(own, parent, grandparent, C, lane); });
}
template <class Real>
void eliminate_band(const ChainBlock<Real>& block, int i) {
  Real *own = VertexRows<Real>(block, i).scratch, *parent = VertexRows<Real>(block, i - 1).scratch,
       *grandparent = VertexRows<Real>(block, i > 1 ? i - 2 : 0).scratch;  // the anchor's rows are zero
  eliminate_row<Real, 0>(own, parent, grandparent);
  eliminate_row<Real, 1>(own, parent, grandparent);
  eliminate_row<Real, 2>(own, parent, grandparent);
  eliminate_row<Real, 3>(own, parent, grandparent);
}
template <class Real, int C>
void substitute_one(Real* own, Real* child, Real* grandchild) {
  each_lane([&](int lane) CUTICLE_INLINED { substitute_row(own, child, grandchild, C, lane); });
}
template <class Real>
void substitute_band(const ChainBlock<Real>& block, int i) {
  const int end = block.links + 1;
  Real *own = VertexRows<Real>(block, i).scratch, *child = VertexRows<Real>(block, i + 1).scratch,
       *grandchild = VertexRows<Real>(block, i + 2 < end ? i + 2 : end).scratch;
  substitute_one<Real, 3>(own, child, grandchild);
  substitute_one<Real, 2>(own, child, grandchild);
  substitute_one<Real, 1>(own, child, grandchild);
  substitute_one<Real, 0>(own, child, grandchild);
}

template <class Real>
void aim(const ChainBlock<Real>& block, int i, StrandRows<Real>& rows) {
  const VertexRows<Real> v(block, i), parent(block, i - 1);
  const Real* const inverse_length = hinge_at(block, i, hinge_row::inverse_length);
  each_lane([&](int lane) CUTICLE_INLINED {
    v.state_at(state_row::tension)[lane] =
        next_tension(Real(0), -v.scratch_at(rod_row::right + 3)[lane], inverse_length[lane], rows.inverse_time[lane]);
    aim_lane(v, parent, lane,
             vector_at(v.scratch_at(rod_row::coast), lane) + vector_at(v.scratch_at(rod_row::right), lane),
             vector_at(v.scratch_at(scratch_row::direction), lane), rows);
  });
}

template <class Real>
void bend_all(const ChainBlock<Real>& block, const StrandRows<Real>& rows) {
  for (int i = 1; i <= block.links; ++i) bend(block, i);
  for (int i = 1; i <= block.links; ++i) eliminate_angle(block, i);
  for (int i = block.links; i >= 1; --i) substitute_angle(block, i);
  for (int i = 1; i <= block.links; ++i) pull(block, i, rows);
}

template <class Real, bool Touches>
void substep(const ChainBlock<Real>& block, const ChainFrame<Real>& frame, const ChainStep<Real>& step,
             StrandRows<Real>& rows) {
  begin(block, step, rows);
  clamp(block, step);
  if constexpr (Touches) place_spheres(block, step, frame);
  for (int i = 1; i <= block.links; ++i) {
    coast(block, i, step, rows);
    if constexpr (Touches) push_out_of_all(frame, step, VertexRows<Real>(block, i));
  }
  bend_all(block, rows);
  for (int i = 1; i <= block.links; ++i) {
    assemble<Real, Touches>(block, i, step, rows);
    eliminate_band(block, i);
  }
  for (int i = block.links; i >= 1; --i) substitute_band(block, i);
  follow_all<Real, Touches>(block, frame, step, rows, [&](int i) { aim(block, i, rows); });
}

template <class Real, bool Touches>
void advance(const ChainBlock<Real>& block, const ChainFrame<Real>& frame) {
  advance_parts(block, frame, [&](const ChainBlock<Real>& part, const ChainStep<Real>& step, StrandRows<Real>& rows) {
    substep<Real, Touches>(part, frame, step, rows);
  });
}

}  // namespace

extern const Kernels CUTICLE_JOIN(kernels_, CUTICLE_BATCH_SET);
const Kernels CUTICLE_JOIN(kernels_, CUTICLE_BATCH_SET) = {{advance<float, false>, advance<float, true>},
                                                           {advance<double, false>, advance<double, true>}};

}  // namespace cuticle::sim::rod
