#pragma once
// Lights as shaders read them (lights.glsl).
#include <array>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "core/view.h"
#include "shadows/light_frame.h"

namespace cuticle::render {

/// As lights.glsl has it.
struct LightRow {
  glm::vec4 place, power, cone;
};
using LightRows = std::array<LightRow, k_max_lights>;

/// The lights, places and directions moved by `transform`, which is rigid. Those beyond k_max_lights are left out.
LightRows light_rows(const std::vector<Light>& lights, const glm::dmat4& transform = glm::dmat4(1));

/// A light as shadow methods take it.
shadows::LightSource source_of(const Light& light);

}  // namespace cuticle::render
