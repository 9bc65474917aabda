#pragma once
// S from lookup tables as a shader puts it together, in float on the CPU: what sampling costs beside the exact model.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "lut/table_set.h"

namespace cuticle::study {

/// What a shader has of two directions: L.T, E.T and the cosine between their parts across the fibre.
struct ShaderInputs {
  float sin_theta_i, sin_theta_o, cos_phi;
};

/// A stored set, its scales applied to the texels.
class TableSampler {
 public:
  /// Error: usage for a layout whose tables do not make S.
  static Result<TableSampler> make(const lut::TableSet& set);
  /// S [1/sr]: every table once, bilinear and clamped, then the layout's terms. cos theta_d comes from a table where
  /// one holds it, else from the half angle. Agrees with lut::sample to 1e-4 (luts_study_test).
  glm::vec3 scattering(const ShaderInputs& in) const;

 private:
  struct Address {
    lut::AxisQuantity quantity;
    float scale, bias;
  };
  struct Texture {
    glm::ivec2 size;
    Address u, v;
    float glass = 0, gap = 0;  ///< of an axis from the caustic: eta^2 - 1, and its gap
    std::vector<glm::vec4> texels;
  };
  /// A factor of a term: one channel, or three that are colours.
  struct Factor {
    std::size_t texture = 0;
    int channel = 0;
    bool is_color = false;
  };

  void add_texture(const lut::Table& table, int size);
  Result<void> add_terms(const lut::TableSet& set);
  float coordinate(const Address& address, const ShaderInputs& in, float cos_theta_d) const;
  glm::vec4 filtered(const Texture& texture, glm::vec2 coordinates) const;
  glm::vec4 fetch(const Texture& texture, const ShaderInputs& in, float cos_theta_d) const;
  float cosine_of_theta_d(const ShaderInputs& in) const;

  std::vector<Texture> textures_;
  std::vector<std::vector<Factor>> terms_;
  int cosine_texture_ = -1, cosine_channel_ = 0;  ///< of the channel that holds cos theta_d
  bool over_cos2_theta_d_ = false;
};

}  // namespace cuticle::study
