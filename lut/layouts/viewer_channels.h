#pragma once
// What layouts share whose N goes by the viewer's inclination: rough fibres, without infinite peaks.
#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut {

inline constexpr Axis k_viewer{AxisQuantity::abs_theta_o, 0, AngleAxes::right, true};
inline constexpr Channel k_smooth_m[] = {
    {"M_R", bsdf::Quantity::M, "R", 0, Texel::for_filter},
    {"M_TT", bsdf::Quantity::M, "TT", 0, Texel::for_filter},
    {"M_TRT", bsdf::Quantity::M, "TRT", 0, Texel::for_filter},
    {"M_residual", bsdf::Quantity::M, "residual", 0, Texel::for_filter},
};
inline constexpr Channel k_smooth_n_tt_r[] = {
    {"N_TT.r", bsdf::Quantity::N, "TT", 0, Texel::for_filter},
    {"N_TT.g", bsdf::Quantity::N, "TT", 1, Texel::for_filter},
    {"N_TT.b", bsdf::Quantity::N, "TT", 2, Texel::for_filter},
    {"N_R", bsdf::Quantity::N, "R", 0, Texel::for_filter},
};
inline constexpr Channel k_smooth_n_trt[] = {
    {"N_TRT.r", bsdf::Quantity::N, "TRT", 0, Texel::for_filter},
    {"N_TRT.g", bsdf::Quantity::N, "TRT", 1, Texel::for_filter},
    {"N_TRT.b", bsdf::Quantity::N, "TRT", 2, Texel::for_filter},
};

}  // namespace cuticle::lut
