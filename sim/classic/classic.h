#pragma once
// The classic solver on the CPU: position Verlet, iterated length constraints, sphere contact. Twin of the kernels.
#include <memory>

#include "sim/classic/settings.h"
#include "sim/rest_pose.h"

namespace cuticle::sim::classic {

/// A solver for these strands, in metres. Effects that are read: "gravity", "colliders". Runs strands in parallel; the
/// result is bit-identical at any number of threads. A strand whose state is not finite after a substep is put back
/// into the rest pose carried by the head, with the head's velocity, and counted; other strands are not touched by
/// that. Error: that of strands::validate.
Result<std::unique_ptr<Solver>> create(const strands::Groom& rest, const registry::ParameterValues& solver,
                                       const EffectBlocks& effects);

}  // namespace cuticle::sim::classic
