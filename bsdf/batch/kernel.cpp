// The loops of one model for one instruction set: compiled several times (bsdf/CMakeLists.txt, cuticle_model_batch)
// with CUTICLE_BATCH, which makes every shared function static and inlined, so that the linker cannot take code of one
// instruction set for another. Every loop is one block of arithmetic without calls or branches, which the compiler
// turns into vectors.
#include <utility>

#include <model_of_batch.h>

#include "bsdf/batch/kernel.h"
#include "core/flush_to_zero.h"
#include "bsdf/shared/directions.glslh"

#define CUTICLE_JOIN_NAMES(a, b) a##b
#define CUTICLE_JOIN(a, b) CUTICLE_JOIN_NAMES(a, b)

namespace cuticle::bsdf::CUTICLE_BATCH_MODEL {
namespace {

using namespace cuticle::bsdf::batch;

FN glm::vec<3, Real> value_at(const Packed<Real>& packed, int quantity, const Directions<Real>& d) {
  if constexpr (requires { evaluate_directions(packed, quantity, d); })
    return evaluate_directions(packed, quantity, d);
  else
    return evaluate_packed(packed, quantity, -1, point_of(d));
}

FNI Directions<float> directions_at(const DirectionPointers& in, int i) {
  return directions_between(glm::vec3(in.light_x[i], in.light_y[i], in.light_z[i]),
                            glm::vec3(in.viewer_x[i], in.viewer_y[i], in.viewer_z[i]), in.h[i]);
}

void evaluate(const Packed<float>& packed, int count, const DirectionPointers& in, const ColorPointers& out) {
  [[maybe_unused]] const FlushToZero guard;
  const Packed<float> numbers = packed;  // copies, which no store can alias
  const DirectionPointers from = in;
  const ColorPointers to = out;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const glm::vec3 value = value_at(numbers, CUTICLE_QUANTITY_S, directions_at(from, i));
    to.red[i] = value.x;
    to.green[i] = value.y;
    to.blue[i] = value.z;
  }
}

void pdf(const Packed<float>& packed, int count, const DirectionPointers& in, float* density) {
  [[maybe_unused]] const FlushToZero guard;
  const Packed<float> numbers = packed;
  const DirectionPointers from = in;
#pragma omp simd
  for (int i = 0; i < count; ++i) density[i] = value_at(numbers, CUTICLE_QUANTITY_PDF, directions_at(from, i)).x;
}

/// A near field draws for an offset too, which its `drawn_offset` may draw.
template <class Real>
constexpr bool draws_for_offset = requires(const Packed<Real>& packed, Real u) {
  sample_directions(packed, u, u, u, u, u, u, u);
};
template <class Real>
constexpr bool draws_directions = draws_for_offset<Real> || requires(const Packed<Real>& packed, Real u) {
  sample_directions(packed, u, u, u, u, u, u);
};

FN glm::vec<3, Real> light_drawn(const Packed<Real>& packed, glm::vec<3, Real> viewer, Real h, Real u0, Real u1,
                                 Real u2, Real u3, [[maybe_unused]] Real u4) {
  const Real cos_o = sqrt(viewer.y * viewer.y + viewer.z * viewer.z);
  if constexpr (draws_for_offset<Real>)
    return light_of(sample_directions(packed, viewer.x, cos_o, drawn_offset(packed, h, u4), u0, u1, u2, u3), viewer);
  else
    return light_of(sample_directions(packed, viewer.x, cos_o, u0, u1, u2, u3), viewer);
}

template <class Real>
void sample(const Packed<Real>& packed, int count, const QueryPointers& in, const VectorPointers& out) {
  [[maybe_unused]] const FlushToZero guard;
  const Packed<Real> numbers = packed;
  const QueryPointers from = in;
  const VectorPointers to = out;
  const float *const u0 = in.u[0], *const u1 = in.u[1], *const u2 = in.u[2], *const u3 = in.u[3], *const u4 = in.u[4];
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const glm::vec3 light = light_drawn(numbers, glm::vec3(from.viewer_x[i], from.viewer_y[i], from.viewer_z[i]),
                                        from.h[i], u0[i], u1[i], u2[i], u3[i], u4[i]);
    to.x[i] = light.x;
    to.y[i] = light.y;
    to.z[i] = light.z;
  }
}

template <class Real>
constexpr bool takes_rows = requires(const ParameterRow<Real>& row, const Directions<Real>& d) {
  evaluate_row(row, 0, d);
};

template <class Real>
int row_numbers() {
  return numbers_in_row(ParameterRow<Real>{});
}

/// The numbers of point i, written one after the other: the compiler unrolls a loop of at most 16, and a loop inside
/// keeps the one over points from becoming vectors.
template <class Real, std::size_t... k>
[[gnu::always_inline]] inline ParameterRow<Real> row_at(const RowPointers& from, int i, std::index_sequence<k...>) {
  ParameterRow<Real> row;
  ((int(k) < numbers_in_row(row) ? void(row.value[k] = from.value[k][i]) : void()), ...);
  return row;
}

template <class Real>
void evaluate_rows(int count, const RowPointers& rows, const DirectionPointers& in, const ColorPointers& out) {
  [[maybe_unused]] const FlushToZero guard;
  const RowPointers parameters = rows;
  const DirectionPointers from = in;
  const ColorPointers to = out;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const auto row = row_at<Real>(parameters, i, std::make_index_sequence<CUTICLE_ROW_COUNT>());
    const glm::vec3 value = evaluate_row(row, CUTICLE_QUANTITY_S, directions_at(from, i));
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
FN glm::vec<3, Real> value_of_one(const Packed<Real>& packed, int quantity, const Directions<Real>& d) {
  if constexpr (requires { evaluate_one_point(packed, quantity, d); })
    return evaluate_one_point(packed, quantity, d);
  else
    return value_at(packed, quantity, d);
}

void evaluate_one(const Packed<float>& packed, const OnePoint& point, float color[3]) {
  const glm::vec3 value = value_of_one(packed, CUTICLE_QUANTITY_S, directions_of_one(point));
  for (int c = 0; c < 3; ++c) color[c] = value[c];
}

float pdf_of_one(const Packed<float>& packed, const OnePoint& point) {
  return value_of_one(packed, CUTICLE_QUANTITY_PDF, directions_of_one(point)).x;
}

template <class Real>
void sample_one(const Packed<Real>& packed, const float viewer[3], float h, const float u[5], float light[3]) {
  const glm::vec3 at(viewer[0], viewer[1], viewer[2]);
  const glm::vec3 drawn = light_drawn(packed, at, h, u[0], u[1], u[2], u[3], u[4]);
  for (int c = 0; c < 3; ++c) light[c] = drawn[c];
}

template <class Real>
constexpr bool integrates = requires(const Packed<Real>& packed, const Directions<Real>& d) {
  evaluate_integral_of(packed, 0, d);
};

template <class Real>
void evaluate_integral(const Packed<Real>& packed, int count, const DirectionPointers& in, const ColorPointers& out) {
  [[maybe_unused]] const FlushToZero guard;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 value = evaluate_integral_of(packed, CUTICLE_QUANTITY_S, directions_at(in, i));
    out.red[i] = value.x;
    out.green[i] = value.y;
    out.blue[i] = value.z;
  }
}

template <class Real>
void pdf_integral(const Packed<Real>& packed, int count, const DirectionPointers& in, float* density) {
  [[maybe_unused]] const FlushToZero guard;
  for (int i = 0; i < count; ++i)
    density[i] = evaluate_integral_of(packed, CUTICLE_QUANTITY_PDF, directions_at(in, i)).x;
}

FN bool holds_for(const Packed<Real>& packed) {
  if constexpr (requires { holds_in_batch(packed); })
    return holds_in_batch(packed);
  else
    return true;
}
bool holds(const Packed<float>& packed) { return holds_for(packed); }

template <class Real>
constexpr Kernels make_kernels() {
  Kernels kernels{
      .holds = holds, .evaluate = evaluate, .pdf = pdf, .evaluate_one = evaluate_one, .pdf_of_one = pdf_of_one};
  if constexpr (draws_directions<Real>) kernels.sample = sample<Real>;
  if constexpr (draws_directions<Real>) kernels.sample_one = sample_one<Real>;
  if constexpr (integrates<Real>) kernels.evaluate_integral = evaluate_integral<Real>;
  if constexpr (integrates<Real>) kernels.pdf_integral = pdf_integral<Real>;
  if constexpr (takes_rows<Real>) kernels.evaluate_rows = evaluate_rows<Real>;
  if constexpr (takes_rows<Real>) kernels.numbers_in_row = row_numbers<Real>;
  return kernels;
}

}  // namespace

extern const Kernels CUTICLE_JOIN(batch_kernels_, CUTICLE_BATCH_SET);
const Kernels CUTICLE_JOIN(batch_kernels_, CUTICLE_BATCH_SET) = make_kernels<float>();

}  // namespace cuticle::bsdf::CUTICLE_BATCH_MODEL
