#pragma once
// Deep pictures and mattes: which scenes can have them.
#include "core/result.h"
#include "scene/scene.h"

namespace cuticle::plan {

/// Whether the scene's way of drawing strands, with its passes, can make the deep pictures and mattes that its outputs
/// ask for; asked before anything is loaded or drawn. Errors: bad_input, with the way or the pass. Test: plan_test.
Result<void> check_told_strands(const scene::Scene& scene);

}  // namespace cuticle::plan
