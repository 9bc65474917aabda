#pragma once
// How shaders read the tables of any layout (tables.glsl): which quantity addresses which axis, and which products make
// S.
#include <array>

#include <glm/vec4.hpp>

#include "gpu/device.h"
#include "lut/table_set.h"

namespace cuticle::render::strand_shading {

inline constexpr std::size_t k_max_tables = 4;  ///< of a layout
inline constexpr std::size_t k_drawn_textures =
    3;  ///< bound for them; those past the second lie in one, one below the other

/// What the shaders are told of a set of tables.
struct DrawnTables {
  std::array<glm::vec4, k_max_tables> maps{};    ///< texture coordinate = value * xy + zw
  std::array<glm::vec4, k_max_tables> scales{};  ///< value = stored * scale
  glm::vec2 caustic{0};                          ///< eta^2 - 1 and gap of an axis from_caustic (lut/caustic.glslh)
  std::array<std::uint32_t, 4> constants{};      ///< k_axes, k_terms, k_more_terms and k_reading of tables.glsl
};
/// Error: bad_input for a layout whose tables do not make S, or of more than four tables or terms of two factors.
Result<DrawnTables> drawn_tables(const lut::TableSet& set);

/// The tables as textures, in the layout's order; those past the second in one.
Result<std::vector<gpu::Texture>> upload_drawn(gpu::Device& device, const lut::TableSet& set, bool mip_levels);

/// Appends `constants`, or zeros where nothing is read.
std::vector<std::uint32_t> with_layout(std::vector<std::uint32_t> before, const lut::TableSet* set);

}  // namespace cuticle::render::strand_shading
