#include "bsdf/scheuermann/shading.h"

namespace cuticle::bsdf::scheuermann {

Result<glm::dvec4> shaded_texel(const registry::ParameterValues& values, const HairTexel& texel,
                                const glm::dvec3& light, const Point& at) {
  registry::ParameterValues here = values;
  here.set("base", texel.base);
  here.set("occlusion", texel.occlusion);
  here.set("shift_texture", texel.shift);
  here.set("mask", texel.noise);
  CUTICLE_ASSIGN(const Model* model, find_model("scheuermann"));
  glm::dvec3 color(0);
  CUTICLE_TRY(evaluate(*model, here, Precision::f64, {Quantity::S, -1, {&at, 1}}, {&color, 1}));
  return glm::dvec4(color * light, texel.alpha);
}

}  // namespace cuticle::bsdf::scheuermann
