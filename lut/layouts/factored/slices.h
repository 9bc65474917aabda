#pragma once
// S of a model where |theta_d| is one number: rows are pairs (theta_i, theta_o), columns azimuths of three colours.
#include "lut/evaluate.h"
#include "lut/layouts/factored/nonnegative_factors.h"

namespace cuticle::lut::factored {

inline constexpr int k_points = 4;  ///< of a texel's azimuths

/// Texels (x, y) of the table over (theta_i, theta_o) with |y - x| = step: those of one |theta_d|.
std::vector<glm::ivec2> diagonal(int size, int step);

/// The slice at a step: S, averaged over the azimuths of each of `size` texels by four points. Column 3 k + c: texel k,
/// colour c. Error: internal where S is negative or not finite; as the source.
Result<Matrix> slice(const Source& source, int size, int step);

/// Fills the tables F and G1, G2, G3 of the layout. Error: usage where S is 0 everywhere; as `slice`.
Result<void> solve(const Source& source, TableSet& set, Progress& progress);

}  // namespace cuticle::lut::factored
