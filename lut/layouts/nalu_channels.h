#pragma once
// What the Nalu layouts share: axes, channels, textures and terms (GPU Gems 2, chapter 23).
#include <numbers>

#include "lut/table_set.h"

namespace cuticle::lut {

/// The four axes over sines and cosines, with their end points on texel centres or on texel borders.
template <bool k_corner_aligned>
struct SineAxes {
  static constexpr Axis u_m{AxisQuantity::sin_theta_i, -1, 1, k_corner_aligned};
  static constexpr Axis v_m{AxisQuantity::sin_theta_o, -1, 1, k_corner_aligned};
  static constexpr Axis u_n{AxisQuantity::cos_phi, -1, 1, k_corner_aligned};
  static constexpr Axis v_n{AxisQuantity::cos_theta_d, 0, 1, k_corner_aligned};
};
/// The four axes over the angles themselves, end points on texel centres.
struct AngleAxes {
  static constexpr double right = std::numbers::pi / 2;
  static constexpr Axis u_m{AxisQuantity::theta_i, -right, right, true};
  static constexpr Axis v_m{AxisQuantity::theta_o, -right, right, true};
  static constexpr Axis u_n{AxisQuantity::phi, 0, 2 * right, true};
  static constexpr Axis v_n{AxisQuantity::theta_d, 0, right, true};
};

/// The fourth channel is for the axes that need it: the first three stand alone, too.
inline constexpr Channel k_nalu_m[] = {
    {"M_R", bsdf::Quantity::M, "R", 0},
    {"M_TT", bsdf::Quantity::M, "TT", 0},
    {"M_TRT", bsdf::Quantity::M, "TRT", 0},
    {"cos_theta_d", bsdf::Quantity::M, "", 0, Texel::point, ChannelSource::cos_theta_d},
};
inline constexpr std::span<const Channel> k_nalu_m_lobes = std::span(k_nalu_m).first<3>();
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
/// N of the three lobes in one texture, for fibres without colour: that of green.
inline constexpr Channel k_grey_n[] = {
    {"N_R", bsdf::Quantity::N, "R", 1},
    {"N_TT", bsdf::Quantity::N, "TT", 1},
    {"N_TRT", bsdf::Quantity::N, "TRT", 1, Texel::cell_average},
};
/// Of fibres whose paths after TRT are one lobe, which leaves evenly over phi.
inline constexpr Channel k_n_residual[] = {
    {"N_residual.r", bsdf::Quantity::N, "residual", 0},
    {"N_residual.g", bsdf::Quantity::N, "residual", 1},
    {"N_residual.b", bsdf::Quantity::N, "residual", 2},
};
inline constexpr Term k_residual_terms[] = {
    {{"M_R", "N_R"}}, {{"M_TT", "N_TT"}}, {{"M_TRT", "N_TRT"}}, {{"M_residual", "N_residual"}}};
/// The three textures.
template <class Axes>
inline constexpr TableLayout k_nalu_tables[] = {
    {"M", Axes::u_m, Axes::v_m, k_nalu_m},
    {"N_TT_R", Axes::u_n, Axes::v_n, k_nalu_n_tt_r},
    {"N_TRT", Axes::u_n, Axes::v_n, k_nalu_n_trt},
};

inline constexpr Term k_nalu_terms[] = {{{"M_R", "N_R"}}, {{"M_TT", "N_TT"}}, {{"M_TRT", "N_TRT"}}};
inline constexpr std::string_view k_three_textures = "S = M_R N_R + M_TT N_TT + M_TRT N_TRT";

/// The registry's entry of a Nalu layout.
inline registry::Entry nalu_entry(std::string_view name, std::string_view summary) {
  static constexpr std::string_view systems[] = {"N12"};
  return {.kind = registry::EntryKind::layout,
          .name = name,
          .summary = summary,
          .source = "GPU Gems 2, chapter 23 (Nguyen and Donnelly 2005)",
          .systems = systems};
}

}  // namespace cuticle::lut
