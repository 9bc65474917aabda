#pragma once
// S for callers who choose to have a viewer's lights made together.
#include "bsdf/model.h"

namespace cuticle::bsdf {

/// As evaluate, of S [1/sr, no cosine], by scattering_from_viewers with `effort` (1 .. 256) times the paths of the
/// values: points in any order, those of one viewer together. A value depends on its own viewer and light alone.
/// Errors: usage, where another quantity than S is asked for, where the model makes no lights together, or for the
/// effort; as check_request. Test: python/tests/test_models.py.
Result<void> evaluate_together(const Model& model, const registry::ParameterValues& values, int effort,
                               const Request& request, std::span<glm::dvec3> out);

}  // namespace cuticle::bsdf
