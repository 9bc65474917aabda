#pragma once
// What a scene's solver is given: effects, and what moves in a frame.
#include <memory>

#include "plan/head_path.h"
#include "plan/plan.h"
#include "plan/strand_set.h"
#include "sim/solver.h"

namespace cuticle::plan {

/// Effects that act on hair and that the plan holds, by name, as solvers take them.
sim::EffectBlocks planned_effects(const scene::Scene& scene, const Plan& plan);

/// The scene's solver on the CPU, with the manual control where the plan holds it. Error: the solver's.
Result<std::unique_ptr<sim::Solver>> make_cpu_solver(const scene::Scene& scene, const StrandSet& set, const Plan& plan);

/// What moves from the frame before to this one; in frame 0 nothing. Its spans lie in `set`.
sim::FrameInput input_of(const scene::Scene& scene, const StrandSet& set, const Plan& plan, const HeadPath& path,
                         int frame);

}  // namespace cuticle::plan
