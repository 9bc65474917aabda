#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::nalu2 {
namespace {

constexpr Channel k_n[] = {
    {"N_TT+N_TRT.r", bsdf::Quantity::N, "TT+TRT", 0, Texel::cell_average},
    {"N_TT+N_TRT.g", bsdf::Quantity::N, "TT+TRT", 1, Texel::cell_average},
    {"N_TT+N_TRT.b", bsdf::Quantity::N, "TT+TRT", 2, Texel::cell_average},
    {"N_R", bsdf::Quantity::N, "R", 0},
};
constexpr TableLayout k_tables[] = {
    {"M", SineAxes<true>::u_m, SineAxes<true>::v_m, k_nalu_m},
    {"N", SineAxes<true>::u_n, SineAxes<true>::v_n, k_n},
};
constexpr Term k_terms[] = {{{"M_R", "N_R"}}, {{"M_TT", "N_TT+N_TRT"}}};

}  // namespace

const Layout& entry() {
  static const Layout layout{
      .entry = nalu_entry("nalu2", "two textures: M_TRT taken as M_TT, N_TT + N_TRT summed beside N_R"),
      .tables = k_tables,
      .composition = "S = M_R N_R + M_TT (N_TT + N_TRT)",
      .terms = k_terms,
      .family = "nalu2"};
  return layout;
}

}  // namespace cuticle::lut::nalu2
