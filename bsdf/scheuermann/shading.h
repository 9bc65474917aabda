#pragma once
// What the shader of Scheuermann 2004 writes to a pixel of a hair polygon.
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "bsdf/model.h"

namespace cuticle::bsdf::scheuermann {

/// What a pixel reads: base colour, alpha, specular shift and noise of the textures, and the vertices' ambient
/// occlusion; all 0 .. 1.
struct HairTexel {
  glm::dvec3 base{1};
  double alpha = 1, shift = 0.5, noise = 1, occlusion = 1;
};

/// Colour (diffuse + specular) x base x light x occlusion, and the texture's alpha. `values`: of the model
/// `scheuermann`, whose base, shift_texture, mask and occlusion the texel replaces; `light`: irradiance across the
/// light's direction; of `at`: theta_i, theta_o and phi. Error: bad_input, as `evaluate`.
Result<glm::dvec4> shaded_texel(const registry::ParameterValues& values, const HairTexel& texel,
                                const glm::dvec3& light, const Point& at);

}  // namespace cuticle::bsdf::scheuermann
