#pragma once
// Many directions at once, in float: a model's formulas over arrays, vectorised by the compiler for several instruction
// sets, of which the best that the processor has is taken at run time. Unit vectors are in the fibre's frame, x along
// it from root to tip; phi counts from y to z. No angle is formed, so nothing is lost near the poles. Denormal results
// count as 0.
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "bsdf/model.h"
#include "core/instruction_set.h"
#include "core/result.h"

namespace cuticle::bsdf {

namespace batch {
struct Kernels;
}

/// Whether this processor has it and this build was made with it.
bool is_supported(InstructionSet set);
InstructionSet best_instruction_set();

/// Unit vectors, or what is written where results are vectors or colours: three arrays of one size.
struct VectorSpans {
  std::span<const float> x, y, z;
};
struct OutputSpans {
  std::span<float> x, y, z;
};

/// Points: unit vectors toward light and viewer, and offsets in [-1, 1]; `h` may be empty where the model is a far
/// field.
struct BatchPoints {
  VectorSpans to_light, to_viewer;
  std::span<const float> h;
};

/// What directions are drawn for, with four random numbers in [0, 1) each (u[0] chooses the lobe), a fifth for far
/// fields, which draw the offset by it, and three more for models that draw without kernels (deon, yan_fur, other
/// forms of marschner). Arrays of the last three that are empty count as 0: such models then draw from a part of the
/// sphere.
struct BatchQueries {
  VectorSpans to_viewer;
  std::span<const float> h;
  std::array<std::span<const float>, 8> u;
};

/// Values of one parameter for every point: "eta", "sigma_a.r", ...
struct VaryingParameter {
  std::string_view name;
  std::span<const float> values;
};

/// One model with its parameters, ready for arrays. Cheap to make; safe to use from several threads. Large batches use
/// all threads; the results do not depend on their number. Arrays must not overlap. All calls refuse arrays whose sizes
/// differ (bad_input, naming the array and both sizes); vectors are not checked: where they are not of unit length to
/// float precision, results are finite but meaningless, and a NaN gives any number. Against the same formulas one by
/// one, in float: bsdf/batch/batch_test.cpp.
class BatchEvaluator {
 public:
  /// Error: usage, where this processor or build lacks the instruction set.
  static Result<BatchEvaluator> make(const Model& model, const registry::ParameterValues& values,
                                     InstructionSet set = best_instruction_set());

  /// S [1/sr], the sum over lobes, without the cosine of theta_i.
  Result<void> evaluate(const BatchPoints& points, const OutputSpans& color) const;
  /// Density of `sample` per steradian.
  Result<void> pdf(const BatchPoints& points, std::span<float> density) const;
  /// Unit vectors toward the light. Error: usage, where the model has no sampler.
  Result<void> sample(const BatchQueries& queries, const OutputSpans& to_light) const;
  /// As evaluate, with parameters that change from point to point, in their range; the others are those given to
  /// `make`. Errors: usage, where the model cannot vary this parameter, listing those that it can.
  Result<void> evaluate_varying(const BatchPoints& points, std::span<const VaryingParameter> varying,
                                const OutputSpans& color) const;

  /// One point by itself, with the parameters prepared before: S, the density, and a unit vector toward the light drawn
  /// by `u` (as of BatchQueries). The formulas of the batch without its flush of denormals: values within 1e-5 of its
  /// own, half of them within 2.4e-7 (bsdf/batch/batch_test.cpp). The same meaning and range of arguments; `h` is
  /// unused in far fields.
  glm::vec3 evaluate(const glm::vec3& to_light, const glm::vec3& to_viewer, float h) const;
  float pdf(const glm::vec3& to_light, const glm::vec3& to_viewer, float h) const;
  /// 0 where the model has no sampler.
  glm::vec3 sample(const glm::vec3& to_viewer, float h, const std::array<float, 5>& u) const;

  /// Whether the loops are vectorised, over points or (chiang's far field, deon, yan_fur) over the nodes of each
  /// point's integral; else points go one by one through the model's scalar formulas (parameters for which the model's
  /// `holds_in_batch` says no, models without kernels).
  bool is_vectorised() const { return kernels_ || integrals_; }
  /// The same for `sample`.
  bool draws_vectorised() const;
  /// Whether every point is an integral, of which a batch makes many in the time of one by the scalar formulas.
  bool integrates() const { return integrals_ != nullptr; }

 private:
  BatchEvaluator(const Model& model, registry::ParameterValues values) : model_(&model), values_(std::move(values)) {}

  const Model* model_;
  registry::ParameterValues values_;
  std::vector<float> numbers_;
  const batch::Kernels* draws() const;
  void evaluate_block(const BatchPoints& points, std::size_t first, int count, const OutputSpans& color) const;
  void pdf_block(const BatchPoints& points, std::size_t first, int count, std::span<float> density) const;

  const batch::Kernels* kernels_ = nullptr;
  const batch::Kernels* integrals_ = nullptr;  ///< where the loops over points do not hold
  bool needs_offset_ = false;
};

}  // namespace cuticle::bsdf
