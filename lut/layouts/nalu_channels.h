#pragma once
// What the Nalu layouts share: the axes and the texture of M (GPU Gems 2, chapter 23).
#include <cuticle/lut/table_set.h>

namespace cuticle::lut {

/// The four axes, with their end points on texel centres or on texel borders.
template <bool k_corner_aligned>
struct NaluAxes {
  static constexpr Axis sin_theta_i{AxisQuantity::sin_theta_i, -1, 1, k_corner_aligned};
  static constexpr Axis sin_theta_o{AxisQuantity::sin_theta_o, -1, 1, k_corner_aligned};
  static constexpr Axis cos_phi{AxisQuantity::cos_phi, -1, 1, k_corner_aligned};
  static constexpr Axis cos_theta_d{AxisQuantity::cos_theta_d, 0, 1, k_corner_aligned};
};

inline constexpr Channel k_nalu_m[] = {
    {"M_R", bsdf::Quantity::M, "R", 0},
    {"M_TT", bsdf::Quantity::M, "TT", 0},
    {"M_TRT", bsdf::Quantity::M, "TRT", 0},
    {"cos_theta_d", bsdf::Quantity::M, "", 0, Texel::point, ChannelSource::cos_theta_d},
};
inline constexpr Channel k_nalu_n_tt_r[] = {
    {"N_TT.r", bsdf::Quantity::N, "TT", 0},
    {"N_TT.g", bsdf::Quantity::N, "TT", 1},
    {"N_TT.b", bsdf::Quantity::N, "TT", 2},
    {"N_R", bsdf::Quantity::N, "R", 0},
};
inline constexpr Channel k_nalu_n_trt[] = {
    {"N_TRT.r", bsdf::Quantity::N, "TRT", 0, Texel::cell_average},
    {"N_TRT.g", bsdf::Quantity::N, "TRT", 1, Texel::cell_average},
    {"N_TRT.b", bsdf::Quantity::N, "TRT", 2, Texel::cell_average},
};
/// The three textures.
template <bool k_corner_aligned>
inline constexpr TableLayout k_nalu_tables[] = {
    {"M", NaluAxes<k_corner_aligned>::sin_theta_i, NaluAxes<k_corner_aligned>::sin_theta_o, k_nalu_m},
    {"N_TT_R", NaluAxes<k_corner_aligned>::cos_phi, NaluAxes<k_corner_aligned>::cos_theta_d, k_nalu_n_tt_r},
    {"N_TRT", NaluAxes<k_corner_aligned>::cos_phi, NaluAxes<k_corner_aligned>::cos_theta_d, k_nalu_n_trt},
};

/// The registry's entry of a Nalu layout.
inline registry::Entry nalu_entry(std::string_view name, std::string_view summary) {
  static constexpr std::string_view systems[] = {"N12"};
  return {.kind = registry::EntryKind::layout,
          .name = name,
          .summary = summary,
          .source = "GPU Gems 2, chapter 23 (Nguyen and Donnelly 2005)",
          .systems = systems};
}
inline constexpr std::string_view k_three_textures = "S = M_R N_R + M_TT N_TT + M_TRT N_TRT";

}  // namespace cuticle::lut
