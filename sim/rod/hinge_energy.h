#pragma once
// Private to sim/rod: the energy of one hinge by the turn from its parent's frame to its child's, for numbers and for
// numbers with derivatives.
#include <numbers>

#include "sim/rod/second_order.h"
#include "sim/rod/strand_energy.h"

namespace cuticle::sim::rod {

/// atan(sqrt r) / sqrt r and its derivatives, from a series where r is small.
struct AngleRatio {
  double value, first, second;
};
inline AngleRatio angle_ratio(double r) {
  if (r < 1e-2)
    return {1 + r * (-1. / 3 + r * (1. / 5 + r * (-1. / 7 + r * (1. / 9 + r * (-1. / 11 + r / 13))))),
            -1. / 3 + r * (2. / 5 + r * (-3. / 7 + r * (4. / 9 + r * (-5. / 11 + r * 6 / 13)))),
            2. / 5 + r * (-6. / 7 + r * (12. / 9 + r * (-20. / 11 + r * 30 / 13)))};
  const double root = std::sqrt(r), value = std::atan(root) / root, inverse = 1 / (1 + r);
  const double first = (inverse - value) / (2 * r);
  return {value, first, (-inverse * inverse - first) / (2 * r) - first / r};
}

constexpr double k_max_bent = 0.8;  ///< square of the sine of half the angle: past it as rod_step.glslh, 127 degrees

/// A vector part times this is the bend: twice the half angle over its sine.
template <class Number>
Number bend_over_sine(const Number& across, const Number& along) {
  const double s = value_of(across), c = value_of(along);
  if (s > k_max_bent * (s + c)) {
    const double scale = 2 * std::asin(std::sqrt(k_max_bent)) / std::sqrt(k_max_bent), n = s + c;
    return composed(across + along, scale / std::sqrt(n), -scale / (2 * n * std::sqrt(n)),
                    3 * scale / (4 * n * n * std::sqrt(n)));
  }
  const Number ratio = across * composed(along, 1 / c, -1 / (c * c), 2 / (c * c * c));
  const AngleRatio f = angle_ratio(value_of(ratio));
  const double root = std::sqrt(c);
  return composed(ratio, 2 * f.value, 2 * f.first, 2 * f.second) *
         composed(along, 1 / root, -1 / (2 * c * root), 3 / (4 * c * c * root));
}

/// Of the quaternion (w, x, y, z) in the parent's frame, of any length.
template <class Number>
Number hinge_energy(const HingeEnergy& hinge, const Number& w, const Number& x, const Number& y, const Number& z) {
  const Number bend = bend_over_sine(x * x + y * y, w * w + z * z);
  const Number off_x = x * bend - hinge.natural_x, off_y = y * bend - hinge.natural_y;
  Number energy = (off_x * off_x + off_y * off_y) * (hinge.bending / 2);
  if (hinge.twisting > 0) {
    const double turn = 2 * std::numbers::pi;
    Number off = angle_of(z, w) * 2 - hinge.natural_twist;
    off = off - turn * std::round(value_of(off) / turn);
    energy = energy + off * off * (hinge.twisting / 2);
  }
  return energy;
}

/// The one of both quaternions of a turn whose twist is the nearer to the natural one.
inline glm::dquat nearer_twist(const HingeEnergy& hinge, const glm::dquat& q) {
  const double off = 2 * std::atan2(q.z, q.w) - hinge.natural_twist;
  return std::lround(off / (2 * std::numbers::pi)) % 2 == 0 ? q : -q;
}

}  // namespace cuticle::sim::rod
