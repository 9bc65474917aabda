#pragma once
// What the entries of every solver of rigid links have.
#include "sim/effect_parameters.h"

namespace cuticle::sim::chains {

constexpr registry::Parameter k_inner_step = inner_step(100, "0.0020833333333333333");
constexpr registry::Parameter k_double_precision = flag_parameter(
    "double_precision", "false", "the CPU computes in double, without wide vectors: for tests and studies");

/// All substeps of a frame, with their effects, are one kernel.
inline std::uint32_t one_dispatch(const registry::ParameterValues&, const registry::FrameShape&) { return 1; }

}  // namespace cuticle::sim::chains
