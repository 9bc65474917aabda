#pragma once
// The procedural head under a groom that was made for another one.
#include <span>

#include "core/result.h"
#include "core/view.h"
#include "strands/growing/growing.h"

namespace cuticle::plan {

/// The sphere that passes nearest to the points (algebraic least squares). Error: bad_input when they lie in a plane or
/// are fewer than 4.
Result<Sphere> fit_sphere(std::span<const glm::vec3> points);

/// The head, scaled and moved so that its scalp's sphere is a little inside that of the roots; y is up, and it
/// faces away from where most roots are, along x or z.
/// Error: bad_input where the roots are not those of a head: no sphere, its radius outside 0.02 .. 1 m, or most roots
/// off it by more than a quarter of the radius.
Result<strands::Head> fitted_head(strands::Head head, std::span<const glm::vec3> roots);

}  // namespace cuticle::plan
