#pragma once
// As many numbers as a register holds, computed with as if they were one: what the formulas of chains are compiled over
// in units of one instruction set, which no symbol may leave, hence the unnamed namespace.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#ifdef __SSE__
#include <immintrin.h>
#endif

#include "core/shared/trigonometry.glslh"
#include "sim/chains/lanes/lanes.glslh"

namespace cuticle::sim::chains {
namespace {

#define CUTICLE_PACKED [[gnu::always_inline]] friend inline

/// A condition for each number: all bits set where it holds.
template <class Whole, int N>
struct Mask {
  typedef Whole Bits __attribute__((vector_size(sizeof(Whole) * N)));
  Bits bits;
  CUTICLE_PACKED Mask operator&&(Mask a, Mask b) { return {a.bits & b.bits}; }
  CUTICLE_PACKED Mask operator||(Mask a, Mask b) { return {a.bits | b.bits}; }
};

template <class Number, int N>
struct Pack {
  typedef Number Numbers __attribute__((vector_size(sizeof(Number) * N)));
  using Whole = std::conditional_t<sizeof(Number) == sizeof(std::int32_t), std::int32_t, std::int64_t>;
  using Condition = Mask<Whole, N>;
  using Scalar = Number;
  static constexpr int count = N;
  Numbers all;

  Pack() = default;
  [[gnu::always_inline]] constexpr Pack(Numbers numbers) : all(numbers) {}
  template <class T>
  requires std::is_arithmetic_v<T>
  [[gnu::always_inline]] constexpr Pack(T number) : all(Number(number) - Numbers{}) {}

  CUTICLE_PACKED Pack operator+(Pack a, Pack b) { return a.all + b.all; }
  CUTICLE_PACKED Pack operator-(Pack a, Pack b) { return a.all - b.all; }
  CUTICLE_PACKED Pack operator*(Pack a, Pack b) { return a.all * b.all; }
  CUTICLE_PACKED Pack operator/(Pack a, Pack b) { return a.all / b.all; }
  CUTICLE_PACKED Pack operator-(Pack a) { return -a.all; }
  CUTICLE_PACKED Pack& operator+=(Pack& a, Pack b) { return a = a + b; }
  CUTICLE_PACKED Pack& operator-=(Pack& a, Pack b) { return a = a - b; }
  CUTICLE_PACKED Pack& operator*=(Pack& a, Pack b) { return a = a * b; }
  CUTICLE_PACKED Pack& operator/=(Pack& a, Pack b) { return a = a / b; }
  CUTICLE_PACKED Condition operator<(Pack a, Pack b) { return {a.all < b.all}; }
  CUTICLE_PACKED Condition operator>(Pack a, Pack b) { return {a.all > b.all}; }
  CUTICLE_PACKED Condition operator<=(Pack a, Pack b) { return {a.all <= b.all}; }
  CUTICLE_PACKED Pack selected(Condition c, Pack a, Pack b) { return c.bits ? a.all : b.all; }
  CUTICLE_PACKED Pack min(Pack a, Pack b) { return b.all < a.all ? b.all : a.all; }
  CUTICLE_PACKED Pack max(Pack a, Pack b) { return a.all < b.all ? b.all : a.all; }
  CUTICLE_PACKED Pack abs(Pack a) { return max(a, -a); }
  CUTICLE_PACKED Pack sqrt(Pack a) {
    return of_each(a, [](Number x) { return std::sqrt(x); });
  }
  CUTICLE_PACKED Pack precise_sin(Pack a) {
    return of_each(a, [](Number x) { return cuticle::precise_sin(x); });
  }
  CUTICLE_PACKED Pack precise_cos(Pack a) {
    return of_each(a, [](Number x) { return cuticle::precise_cos(x); });
  }
  CUTICLE_PACKED Pack safe_asin(Pack a) {
    return of_each(a, [](Number x) { return cuticle::safe_asin(x); });
  }

 private:
  template <class Function>
  [[gnu::always_inline]] static Pack of_each(Pack a, const Function& function) {
    Number numbers[N];
    std::memcpy(numbers, &a.all, sizeof numbers);
#pragma omp simd
    for (int k = 0; k < N; ++k) numbers[k] = function(numbers[k]);
    std::memcpy(&a.all, numbers, sizeof numbers);
    return a;
  }
};

#ifdef __AVX512F__
constexpr std::size_t k_register = 64;
#elif defined(__AVX2__)
constexpr std::size_t k_register = 32;
#else
constexpr std::size_t k_register = 16;
#endif
/// A register full of Number.
template <class Number>
using Lanes = Pack<Number, int(k_register / sizeof(Number))>;

template <class Whole, int N>
[[gnu::always_inline]] inline bool any(Mask<Whole, N> mask) {
#if defined(__AVX512F__)
  return _mm512_test_epi64_mask((__m512i)mask.bits, (__m512i)mask.bits) != 0;
#elif defined(__AVX2__)
  return !_mm256_testz_si256((__m256i)mask.bits, (__m256i)mask.bits);
#else
  Whole found = 0;
  for (int k = 0; k < N; ++k) found |= mask.bits[k];
  return found != 0;
#endif
}

#if defined(__AVX2__) && defined(CUTICLE_ESTIMATES)
/// An estimate and a step of Newton's (AVX2's estimate has fewer digits: one of third order), for units that can spare
/// the last digit: a division takes the processor ten times as long. Not a number at 0 and infinity.
[[gnu::always_inline]] inline Lanes<float> reciprocal(Lanes<float> x) {
#ifdef __AVX512F__
  const Lanes<float> near = _mm512_maskz_rcp14_ps(__mmask16(-1), x.all);
  return near + near * (Lanes<float>(1) - x * near);
#else
  const Lanes<float> near = _mm256_rcp_ps(x.all), off = Lanes<float>(1) - x * near;
  return near + near * (off + off * off);
#endif
}
[[gnu::always_inline]] inline Lanes<float> reciprocal_root(Lanes<float> x) {
#ifdef __AVX512F__
  const Lanes<float> near = _mm512_maskz_rsqrt14_ps(__mmask16(-1), x.all);
  return near + near * (Lanes<float>(0.5) - Lanes<float>(0.5) * near * (x * near));
#else
  const Lanes<float> near = _mm256_rsqrt_ps(x.all), off = Lanes<float>(1) - near * (x * near);
  return near + near * off * (Lanes<float>(0.5) + Lanes<float>(0.375) * off);
#endif
}
#endif

#undef CUTICLE_PACKED

}  // namespace
}  // namespace cuticle::sim::chains

namespace cuticle::sim {
template <class Number, int N>
struct FlagOf<chains::Pack<Number, N>> {
  using Type = typename chains::Pack<Number, N>::Condition;
};
}  // namespace cuticle::sim
