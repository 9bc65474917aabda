#include "bsdf/scheuermann/shading.h"

#include "bsdf/scheuermann/scheuermann.h"

namespace cuticle::bsdf::scheuermann {

Result<glm::dvec4> shaded_texel(const registry::ParameterValues& values, const HairTexel& texel,
                                const glm::dvec3& light, const Point& at) {
  auto here = registry::from_values<Parameters>(values);
  here.base = texel.base;
  here.occlusion = texel.occlusion;
  here.shift_texture = texel.shift;
  here.mask = texel.noise;
  CUTICLE_ASSIGN(const Model* model, find_model("scheuermann"));
  glm::dvec3 color(0);
  CUTICLE_TRY(evaluate(*model, registry::to_values(here), Precision::f64, {Quantity::S, -1, {&at, 1}}, {&color, 1}));
  return glm::dvec4(color * light, texel.alpha);
}

}  // namespace cuticle::bsdf::scheuermann
