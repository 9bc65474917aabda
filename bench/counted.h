#pragma once
// A number that counts the operations done with it. The elementary functions are those of float (BY_REAL would take the
// standard ones): each is specialised before a formula can ask for it.
#include "core/shared/bessel.glslh"
#include "core/shared/logarithm.glslh"
#include "core/shared/rotation.glslh"

namespace cuticle::bench {

struct Counted {
  float value;
  static inline long operations = 0;

  Counted() = default;
  Counted(double number) : value(float(number)) {}
  explicit operator int() const { return int(value); }
  explicit operator double() const { return double(value); }
};

inline Counted counted(float value) {
  ++Counted::operations;
  return Counted(double(value));
}
inline Counted operator+(Counted a, Counted b) { return counted(a.value + b.value); }
inline Counted operator-(Counted a, Counted b) { return counted(a.value - b.value); }
inline Counted operator*(Counted a, Counted b) { return counted(a.value * b.value); }
inline Counted operator/(Counted a, Counted b) { return counted(a.value / b.value); }
inline Counted operator-(Counted a) { return Counted(double(-a.value)); }
inline Counted& operator+=(Counted& a, Counted b) { return a = a + b; }
inline Counted& operator-=(Counted& a, Counted b) { return a = a - b; }
inline Counted& operator*=(Counted& a, Counted b) { return a = a * b; }
inline Counted& operator/=(Counted& a, Counted b) { return a = a / b; }
inline bool operator<(Counted a, Counted b) { return ++Counted::operations, a.value < b.value; }
inline bool operator>(Counted a, Counted b) { return ++Counted::operations, a.value > b.value; }
inline bool operator<=(Counted a, Counted b) { return ++Counted::operations, a.value <= b.value; }
inline bool operator>=(Counted a, Counted b) { return ++Counted::operations, a.value >= b.value; }
inline bool operator==(Counted a, Counted b) { return ++Counted::operations, a.value == b.value; }
inline Counted abs(Counted a) { return Counted(double(std::abs(a.value))); }
inline Counted sqrt(Counted a) { return counted(std::sqrt(a.value)); }
inline Counted floor(Counted a) { return counted(std::floor(a.value)); }
inline int floatBitsToInt(Counted a) { return cuticle::floatBitsToInt(a.value); }

}  // namespace cuticle::bench

namespace cuticle {

using bench::Counted;
template <>
inline Counted precise_exp(Counted x) {
  return exp_own(x);
}
template <>
inline Counted precise_decay(Counted depth) {
  return decay_own(depth);
}
template <>
inline Counted one_minus_exp(Counted t) {
  return one_minus_exp_own(t);
}
template <>
inline Counted bessel_i0_damped(Counted x, Counted depth) {
  return bessel_i0_damped_short(abs(x), depth);
}
template <>
inline Counted precise_log(Counted x) {
  return log_own(x);
}
template <>
inline Counted log_of_share(Counted x, Counted q) {
  return log_of_share_own(x, q);
}
template <>
inline Counted precise_atan2(Counted y, Counted x) {
  return atan2_own(y, x);
}
template <>
inline glm::vec<2, Counted> precise_rotation(Counted x) {
  return rotation_own(x);
}
template <>
inline Counted precise_sin(Counted x) {
  return rotation_own(x).y;
}
template <>
inline Counted precise_cos(Counted x) {
  return rotation_own(x).x;
}

}  // namespace cuticle
