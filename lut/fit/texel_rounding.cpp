#include <algorithm>

#include "lut/fit/detail/texel_problem.h"

namespace cuticle::lut {
namespace {

constexpr int k_max_sweeps = 50;

}  // namespace

void round_with_neighbours(const TexelProblem& problem, double (*round)(double), double scale, double largest,
                           std::vector<double>& texels) {
  for (int sweep = 0, changes = 1; changes > 0 && sweep < k_max_sweeps; ++sweep) {
    changes = 0;
    for (int row = 0; row < problem.size; ++row)
      for (int column = 0; column < problem.size; ++column) {
        double& texel = texels[std::size_t(row) * std::size_t(problem.size) + std::size_t(column)];
        const Parabola parabola = along(problem, texels, column, row);
        if (!(parabola.curvature > 0) || texel >= scale * largest) continue;  // the peak gives the scale
        const double best = texel - parabola.slope / parabola.curvature;
        const double rounded = round(std::clamp(best / scale, 0.0, largest)) * scale;
        changes += rounded != texel;
        texel = rounded;
      }
  }
}

}  // namespace cuticle::lut
