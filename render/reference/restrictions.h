#pragma once
// What real-time ways leave out or put in the place of something, one at a time, so that an error is laid to its cause.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bsdf/batch/batch.h"
#include "render/reference/fibre_point.h"
#include "render/reference/traced_scene.h"
#include "shadows/method.h"

namespace cuticle::render::reference {

/// Lookup tables in the place of the model's formulas, stored as halves.
struct TablesInstead {
  std::string layout = "nalu";  ///< of lut::layouts(), with terms
  int size = 128;               ///< texels each way
};

/// A shadow method in the place of rays from fibres to lights.
struct ShadowsInstead {
  std::string method = "truth";  ///< of shadows::methods()
  registry::ParameterValues values = {};
  glm::dvec3 alpha{0.4};   ///< opacity of a fibre crossing, per channel, 0 .. 1
  double fibre_width = 1;  ///< shadows::Receivers::fibre_width
};

/// S of the far field from tables. Safe to use from several threads. Test: reference_test.cpp.
class TableScattering {
 public:
  /// Errors: usage, where the layout's tables do not make S; those of lut::bake.
  static Result<std::unique_ptr<TableScattering>> make(const bsdf::Model& model,
                                                       const registry::ParameterValues& values,
                                                       const TablesInstead& choice);
  ~TableScattering();
  /// As bsdf::BatchEvaluator::evaluate.
  void evaluate(const bsdf::BatchPoints& points, const bsdf::OutputSpans& color) const;

 private:
  struct Parts;
  explicit TableScattering(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

/// What of each light arrives at hair: the method's transmittance at the vertices, between them interpolated, as the
/// real-time ways have it. Test: reference_test.cpp.
class VertexTransmittance {
 public:
  /// Errors: usage for an unknown method; the method's.
  static Result<VertexTransmittance> make(const TracedScene& scene, const ShadowsInstead& choice);
  /// 0 .. 1, per channel; `light`: index of the scene's.
  glm::dvec3 at(std::size_t light, const FibrePoint& point) const;

 private:
  std::vector<std::vector<glm::vec3>> of_light_;  ///< per vertex
};

}  // namespace cuticle::render::reference
