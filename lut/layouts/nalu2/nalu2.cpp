#include <cuticle/lut/layouts/nalu_channels.h>

namespace cuticle::lut::nalu2 {
namespace {

constexpr Channel k_n[] = {
    {"N_TT+N_TRT.r", bsdf::Quantity::N, "TT+TRT", 0, Texel::cell_average},
    {"N_TT+N_TRT.g", bsdf::Quantity::N, "TT+TRT", 1, Texel::cell_average},
    {"N_TT+N_TRT.b", bsdf::Quantity::N, "TT+TRT", 2, Texel::cell_average},
    {"N_R", bsdf::Quantity::N, "R", 0},
};
constexpr TableLayout k_tables[] = {
    {"M", NaluAxes<true>::sin_theta_i, NaluAxes<true>::sin_theta_o, k_nalu_m},
    {"N", NaluAxes<true>::cos_phi, NaluAxes<true>::cos_theta_d, k_n},
};

}  // namespace

const Layout& entry() {
  static const Layout layout{nalu_entry("nalu2", "two textures: M_TRT taken as M_TT, N_TT + N_TRT summed beside N_R"),
                             k_tables, "S = M_R N_R + M_TT (N_TT + N_TRT)"};
  return layout;
}

}  // namespace cuticle::lut::nalu2
