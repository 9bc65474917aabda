#include "python/unit_vectors.h"

#include <numbers>

#include "core/shared/rotation.glslh"

namespace cuticle::python {
namespace {

/// Radians within half a turn, which float holds to 2e-7. Adding and taking 1.5 * 2^52 rounds to a whole number.
float radians(double degrees) {
  constexpr double rounding = 6755399441055744.0, turn = 360;
  const double turns = (degrees / turn + rounding) - rounding;
  return float((degrees - turn * turns) * (std::numbers::pi / 180));
}

// Compiled for several instruction sets, of which the best that the processor has is taken: the same bits from each.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
#define CUTICLE_FOR_EACH_PROCESSOR __attribute__((target_clones("default", "avx2", "avx512f"), flatten))
#else
#define CUTICLE_FOR_EACH_PROCESSOR
#endif

/// Columns x, y, z of so many directions from their angles in degrees: x along the fibre, azimuth from y to z.
/// Directions past a pole by rounding (cosine below 0) stay there.
CUTICLE_FOR_EACH_PROCESSOR
void set_directions(const double* theta, const double* phi, const double* less, std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec2 up = precise_rotation(radians(theta[i])), around = precise_rotation(radians(phi[i] - less[i]));
    const float across = up.x > 0 ? up.x : 0.0f;
    out[i] = up.y;
    out[count + i] = across * around.x;
    out[2 * count + i] = across * around.y;
  }
}

}  // namespace

void UnitVectors::set(std::span<const double> columns, std::size_t count) {
  count_ = count;
  planes_.resize(7 * count);
  const double *theta_i = columns.data(), *theta_o = theta_i + count, *phi = theta_o + count, *phi_o = phi + count,
               *h = phi_o + count;
  float* const out = planes_.data();
  zeros_.assign(count, 0);
  set_directions(theta_i, phi_o, phi, count, out);
  set_directions(theta_o, phi_o, zeros_.data(), count, out + 3 * count);
  for (std::size_t i = 0; i < count; ++i) out[6 * count + i] = float(h[i]);
}

bsdf::BatchPoints UnitVectors::points() const {
  return {{plane(0), plane(1), plane(2)}, {plane(3), plane(4), plane(5)}, plane(6)};
}

}  // namespace cuticle::python
