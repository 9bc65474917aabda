// The loops of one model for one instruction set: compiled several times (bsdf/CMakeLists.txt, cuticle_model_batch)
// with CUTICLE_BATCH, which makes every shared function static and inlined, so that the linker cannot take code of one
// instruction set for another. Every loop is one block of arithmetic without calls or branches, which the compiler
// turns into vectors.
#include <utility>

#include <model_of_batch.h>

#include "bsdf/batch/kernel.h"
#include "bsdf/shared/directions.glslh"
#include "core/flush_to_zero.h"
#include "core/join.h"

namespace cuticle::bsdf::CUTICLE_BATCH_MODEL {
namespace {

using namespace cuticle::bsdf::batch;

FN glm::vec<3, Real> value_at(const Prepared<Real>& prepared, int quantity, const Directions<Real>& d) {
  if constexpr (requires { evaluate_directions(prepared, quantity, d); })
    return evaluate_directions(prepared, quantity, d);
  else
    return evaluate(prepared, quantity, -1, point_of(d));
}

FNI Directions<float> directions_at(const DirectionPointers& in, int i) {
  return directions_between(glm::vec3(in.light_x[i], in.light_y[i], in.light_z[i]),
                            glm::vec3(in.viewer_x[i], in.viewer_y[i], in.viewer_z[i]), in.h[i]);
}

/// The model's struct where its numbers lie.
FNI const Prepared<float>& prepared_at(const float* numbers) {
  return *reinterpret_cast<const Prepared<float>*>(numbers);
}

template <class Real>
void evaluate(const float* numbers, int count, const DirectionPointers& in, const ColorPointers& out) {
  [[maybe_unused]] const FlushToZero guard;
  const Prepared<Real> prepared = prepared_at(numbers);  // copies, which no store can alias
  const DirectionPointers from = in;
  const ColorPointers to = out;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const glm::vec3 value = value_at(prepared, CUTICLE_QUANTITY_S, directions_at(from, i));
    to.red[i] = value.x;
    to.green[i] = value.y;
    to.blue[i] = value.z;
  }
}

template <class Real>
void pdf(const float* numbers, int count, const DirectionPointers& in, float* density) {
  [[maybe_unused]] const FlushToZero guard;
  const Prepared<Real> prepared = prepared_at(numbers);
  const DirectionPointers from = in;
#pragma omp simd
  for (int i = 0; i < count; ++i) density[i] = value_at(prepared, CUTICLE_QUANTITY_PDF, directions_at(from, i)).x;
}

/// A near field draws for an offset too, which its `drawn_offset` may draw.
template <class Real>
constexpr bool draws_for_offset = requires(const Prepared<Real>& prepared, Real u) {
  sample_directions(prepared, u, u, u, u, u, u, u);
};
template <class Real>
constexpr bool draws_directions = draws_for_offset<Real> || requires(const Prepared<Real>& prepared, Real u) {
  sample_directions(prepared, u, u, u, u, u, u);
};

FN glm::vec<3, Real> light_drawn(const Prepared<Real>& prepared, glm::vec<3, Real> viewer, Real h, Real u0, Real u1,
                                 Real u2, Real u3, [[maybe_unused]] Real u4) {
  const Real cos_o = sqrt(viewer.y * viewer.y + viewer.z * viewer.z);
  if constexpr (draws_for_offset<Real>)
    return light_of(sample_directions(prepared, viewer.x, cos_o, drawn_offset(prepared, h, u4), u0, u1, u2, u3),
                    viewer);
  else
    return light_of(sample_directions(prepared, viewer.x, cos_o, u0, u1, u2, u3), viewer);
}

template <class Real>
void sample(const float* numbers, int count, const QueryPointers& in, const VectorPointers& out) {
  [[maybe_unused]] const FlushToZero guard;
  const Prepared<Real> prepared = prepared_at(numbers);
  const QueryPointers from = in;
  const VectorPointers to = out;
  const float *const u0 = in.u[0], *const u1 = in.u[1], *const u2 = in.u[2], *const u3 = in.u[3], *const u4 = in.u[4];
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const glm::vec3 light = light_drawn(prepared, glm::vec3(from.viewer_x[i], from.viewer_y[i], from.viewer_z[i]),
                                        from.h[i], u0[i], u1[i], u2[i], u3[i], u4[i]);
    to.x[i] = light.x;
    to.y[i] = light.y;
    to.z[i] = light.z;
  }
}

template <class Real>
constexpr bool takes_varying = requires(const Varying<Real>& varying, const Directions<Real>& d) {
  evaluate_varying(varying, 0, d);
};

template <class Real>
int varying_numbers() {
  return int(sizeof(Varying<Real>) / sizeof(Real));
}

/// The numbers of point i, written one after the other: the compiler unrolls a loop of at most 16, and a loop inside
/// keeps the one over points from becoming vectors.
template <class Real, std::size_t... k>
[[gnu::always_inline]] inline Varying<Real> varying_at(const VaryingPointers& from, int i, std::index_sequence<k...>) {
  Varying<Real> varying;
  Real* const numbers = reinterpret_cast<Real*>(&varying);
  ((numbers[k] = from.value[k][i]), ...);
  return varying;
}

template <class Real>
void evaluate_varying_points(int count, const VaryingPointers& varying, const DirectionPointers& in,
                             const ColorPointers& out) {
  [[maybe_unused]] const FlushToZero guard;
  const VaryingPointers parameters = varying;
  const DirectionPointers from = in;
  const ColorPointers to = out;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const auto at = varying_at<Real>(parameters, i, std::make_index_sequence<sizeof(Varying<Real>) / sizeof(Real)>());
    const glm::vec3 value = evaluate_varying(at, CUTICLE_QUANTITY_S, directions_at(from, i));
    to.red[i] = value.x;
    to.green[i] = value.y;
    to.blue[i] = value.z;
  }
}

/// Without the guard of the loops, which costs as much as a fifth of a point.
FNI Directions<float> directions_of_one(const OnePoint& point) {
  return directions_between(glm::vec3(point.light[0], point.light[1], point.light[2]),
                            glm::vec3(point.viewer[0], point.viewer[1], point.viewer[2]), point.h);
}

/// A model may have formulas for one point that leave a loop when it is done.
FN glm::vec<3, Real> value_of_one(const Prepared<Real>& prepared, int quantity, const Directions<Real>& d) {
  if constexpr (requires { evaluate_one_point(prepared, quantity, d); })
    return evaluate_one_point(prepared, quantity, d);
  else
    return value_at(prepared, quantity, d);
}

template <class Real>
void evaluate_one(const float* numbers, const OnePoint& point, float color[3]) {
  const glm::vec<3, Real> value = value_of_one(prepared_at(numbers), CUTICLE_QUANTITY_S, directions_of_one(point));
  for (int c = 0; c < 3; ++c) color[c] = value[c];
}

template <class Real>
Real pdf_of_one(const float* numbers, const OnePoint& point) {
  return value_of_one(prepared_at(numbers), CUTICLE_QUANTITY_PDF, directions_of_one(point)).x;
}

template <class Real>
void sample_one(const float* numbers, const float viewer[3], float h, const float u[5], float light[3]) {
  const glm::vec3 at(viewer[0], viewer[1], viewer[2]);
  const glm::vec3 drawn = light_drawn(prepared_at(numbers), at, h, u[0], u[1], u[2], u[3], u[4]);
  for (int c = 0; c < 3; ++c) light[c] = drawn[c];
}

template <class Real>
constexpr bool integrates = requires(const Prepared<Real>& prepared, const Directions<Real>& d) {
  evaluate_integral_of(prepared, 0, d);
};

/// A model of which every point is an integral has no loops over points.
template <class Real>
constexpr bool only_integrates =
    integrates<Real> && !requires(const Prepared<Real>& prepared, const Directions<Real>& d) {
  evaluate_directions(prepared, 0, d);
};

template <class Real>
void evaluate_integral(const float* numbers, int count, const DirectionPointers& in, const ColorPointers& out) {
  [[maybe_unused]] const FlushToZero guard;
  const Prepared<Real> prepared = prepared_at(numbers);
  for (int i = 0; i < count; ++i) {
    const glm::vec3 value = evaluate_integral_of(prepared, CUTICLE_QUANTITY_S, directions_at(in, i));
    out.red[i] = value.x;
    out.green[i] = value.y;
    out.blue[i] = value.z;
  }
}

template <class Real>
void pdf_integral(const float* numbers, int count, const DirectionPointers& in, float* density) {
  [[maybe_unused]] const FlushToZero guard;
  const Prepared<Real> prepared = prepared_at(numbers);
  for (int i = 0; i < count; ++i)
    density[i] = evaluate_integral_of(prepared, CUTICLE_QUANTITY_PDF, directions_at(in, i)).x;
}

FN bool holds_for(const Prepared<Real>& prepared) {
  if constexpr (requires { holds_in_batch(prepared); })
    return holds_in_batch(prepared);
  else
    return true;
}
bool holds(const float* numbers) { return holds_for(prepared_at(numbers)); }

template <class Real>
constexpr Kernels make_kernels() {
  Kernels kernels{.holds = holds};
  if constexpr (!only_integrates<Real>) {
    kernels.evaluate = evaluate<Real>;
    kernels.pdf = pdf<Real>;
    kernels.evaluate_one = evaluate_one<Real>;
    kernels.pdf_of_one = pdf_of_one<Real>;
  }
  if constexpr (draws_directions<Real>) kernels.sample = sample<Real>;
  if constexpr (draws_directions<Real>) kernels.sample_one = sample_one<Real>;
  if constexpr (integrates<Real>) kernels.evaluate_integral = evaluate_integral<Real>;
  if constexpr (integrates<Real>) kernels.pdf_integral = pdf_integral<Real>;
  if constexpr (takes_varying<Real>) kernels.evaluate_varying = evaluate_varying_points<Real>;
  if constexpr (takes_varying<Real>) kernels.varying_numbers = varying_numbers<Real>;
  return kernels;
}

}  // namespace

extern const Kernels CUTICLE_JOIN(batch_kernels_, CUTICLE_BATCH_SET);
const Kernels CUTICLE_JOIN(batch_kernels_, CUTICLE_BATCH_SET) = make_kernels<float>();

}  // namespace cuticle::bsdf::CUTICLE_BATCH_MODEL
