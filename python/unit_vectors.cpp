#include "python/unit_vectors.h"

#include <cmath>
#include <numbers>

#include "core/shared/rotation.glslh"

namespace cuticle::python {
namespace {

/// The same direction within half a turn, which float holds to 2e-7.
float within_half_a_turn(double phi) {
  constexpr double turn = 2 * std::numbers::pi;
  return float(phi - turn * std::floor(phi / turn + 0.5));
}

/// x along the fibre, azimuth from y to z. Directions past a pole by rounding (cosine below 0) stay there.
void set_direction(float theta, float phi, float* x, float* y, float* z) {
  const glm::vec2 up = precise_rotation(theta), around = precise_rotation(phi);
  const float across = std::max(up.x, 0.0f);
  *x = up.y, *y = across * around.x, *z = across * around.y;
}

}  // namespace

void UnitVectors::set(std::span<const bsdf::Point> points) {
  count_ = points.size();
  planes_.resize(7 * count_);
  float* const out = planes_.data();
  for (std::size_t i = 0; i < count_; ++i) {
    const bsdf::Point& at = points[i];
    float* const to = out + i;
    set_direction(float(at.theta_i), within_half_a_turn(at.phi_o - at.phi), to, to + count_, to + 2 * count_);
    set_direction(float(at.theta_o), within_half_a_turn(at.phi_o), to + 3 * count_, to + 4 * count_, to + 5 * count_);
    to[6 * count_] = float(at.h);
  }
}

bsdf::BatchPoints UnitVectors::points() const {
  return {{plane(0), plane(1), plane(2)}, {plane(3), plane(4), plane(5)}, plane(6)};
}

}  // namespace cuticle::python
