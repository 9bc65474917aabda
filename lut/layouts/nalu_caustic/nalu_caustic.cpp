#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::nalu_caustic {
namespace {

constexpr Axis k_from_caustic{AxisQuantity::from_caustic, -1, 1, true};
constexpr Channel k_m[] = {
    {"M_R", bsdf::Quantity::M, "R", 0, Texel::for_filter},
    {"M_TT", bsdf::Quantity::M, "TT", 0, Texel::for_filter},
    {"M_TRT", bsdf::Quantity::M, "TRT", 0, Texel::for_filter},
};
constexpr Channel k_n_trt[] = {
    {"N_TRT.r", bsdf::Quantity::N, "TRT", 0},
    {"N_TRT.g", bsdf::Quantity::N, "TRT", 1},
    {"N_TRT.b", bsdf::Quantity::N, "TRT", 2},
};
constexpr TableLayout k_tables[] = {
    {"M", AngleAxes::u_m, AngleAxes::v_m, k_m},
    {"N_TT_R", AngleAxes::u_n, AngleAxes::v_n, k_nalu_n_tt_r},
    {"N_TRT", k_from_caustic, AngleAxes::v_n, k_n_trt},
};

}  // namespace

const Layout& entry() {
  static const Layout layout{
      .entry = nalu_entry("nalu_caustic",
                          "as nalu_theta, with N_TRT over the root of the azimuth from its caustic, without its peak"),
      .tables = k_tables,
      .composition = k_three_textures,
      .terms = k_nalu_terms,
      .family = "nalu"};
  return layout;
}

}  // namespace cuticle::lut::nalu_caustic
