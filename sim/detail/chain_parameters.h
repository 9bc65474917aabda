#pragma once
// Parameters that every solver of rigid links has: rows of their entries' tables.
#include <cuticle/core/registry/entry.h>

namespace cuticle::sim::detail {

inline constexpr registry::Parameter k_inner_step = {
    .name = "inner_step",
    .type = registry::ParameterType::real,
    .unit = "s",
    .minimum = 1e-5,
    .maximum = 100,
    .default_text = "0.0020833333333333333",
    .summary = "longest substep; a frame is cut into equal parts of at most this"};
inline constexpr registry::Parameter k_max_substeps = {
    .name = "max_substeps",
    .type = registry::ParameterType::integer,
    .minimum = 1,
    .maximum = 4096,
    .default_text = "64",
    .summary = "most substeps in a frame; past that the substep stretches"};
inline constexpr registry::Parameter k_damping = {
    .name = "damping",
    .type = registry::ParameterType::real,
    .unit = "1/s",
    .minimum = 0,
    .maximum = 1000,
    .default_text = "2",
    .summary = "drag of still air: velocity decays as exp(-damping t)"};
inline constexpr registry::Parameter k_double_precision = {
    .name = "double_precision",
    .type = registry::ParameterType::boolean,
    .default_text = "false",
    .summary = "the CPU computes in double, without wide vectors: for tests and studies"};
inline constexpr std::string_view k_demands[] = {"simulation"};

/// All substeps of a frame, with their effects, are one kernel.
inline std::uint32_t one_dispatch(const registry::ParameterValues&, const registry::FrameShape&) { return 1; }

}  // namespace cuticle::sim::detail
