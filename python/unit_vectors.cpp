#include "python/unit_vectors.h"

#include <algorithm>
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

/// x along the fibre, azimuth from y to z. Directions past a pole by rounding (cosine below 0) stay there.
void set_direction(double theta, double phi, float* out, std::size_t stride) {
  const glm::vec2 up = precise_rotation(radians(theta)), around = precise_rotation(radians(phi));
  const float across = std::max(up.x, 0.0f);
  out[0] = up.y;
  out[stride] = across * around.x;
  out[2 * stride] = across * around.y;
}

}  // namespace

void UnitVectors::set(std::span<const double> columns, std::size_t count) {
  count_ = count;
  planes_.resize(7 * count);
  const double *theta_i = columns.data(), *theta_o = theta_i + count, *phi = theta_o + count, *phi_o = phi + count,
               *h = phi_o + count;
  float* const out = planes_.data();
  for (std::size_t i = 0; i < count; ++i) set_direction(theta_i[i], phi_o[i] - phi[i], out + i, count);
  for (std::size_t i = 0; i < count; ++i) set_direction(theta_o[i], phi_o[i], out + 3 * count + i, count);
  for (std::size_t i = 0; i < count; ++i) out[6 * count + i] = float(h[i]);
}

bsdf::BatchPoints UnitVectors::points() const {
  return {{plane(0), plane(1), plane(2)}, {plane(3), plane(4), plane(5)}, plane(6)};
}

}  // namespace cuticle::python
