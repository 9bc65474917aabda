#pragma once
// Rows of the parameter tables that several solvers have, and how they are read.
#include "core/registry/members.h"
#include "sim/head_motion.h"

namespace cuticle::sim {

constexpr registry::Parameter inner_step_row(double longest) {
  return registry::row("inner_step", "s", 1e-5, longest,
                       "longest substep; a frame is cut into equal parts of at most this");
}
constexpr registry::Parameter k_max_substeps =
    registry::row("max_substeps", "1", 1, 4096, "most substeps in a frame; past that the substep stretches");
constexpr registry::Parameter k_damping =
    registry::row("damping", "1/s", 0, 1000, "drag of still air: velocity decays as exp(-damping t)");
constexpr registry::Parameter k_shape_stiffness =
    registry::row("shape_stiffness", "1/s", 0, 1000,
                  "rate of the critically damped pull towards the rest pose carried by the head, at the root");
constexpr registry::Parameter k_shape_tip =
    registry::row("shape_tip", "1", 0, 1, "share of the shape stiffness left at the tip");
constexpr registry::Parameter k_sag_free =
    registry::row("sag_free", "1", 0, 0,
                  "the groom is combed under gravity: the pull, if there is one, carries the weight of the rest pose");
constexpr registry::Parameter k_clamped_vertices = registry::row(
    "clamped_vertices", "1", 1, 2,
    "first vertices of a strand that the head carries: 2 keeps the direction in which hair leaves the scalp");

constexpr std::string_view k_solver_demands[] = {"simulation"};

/// Effect::substeps of a solver with the parameters T.
template <class T>
std::uint32_t substeps_of(const registry::ParameterValues& solver, double duration) {
  const T settings = registry::from_values<T>(solver);
  return inner_steps(duration, settings.inner_step, settings.max_substeps);
}

}  // namespace cuticle::sim
