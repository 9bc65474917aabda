#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::nalu_theta {
namespace {

constexpr TableLayout k_tables[] = {
    {"M", AngleAxes::u_m, AngleAxes::v_m, k_nalu_m_lobes},
    {"N_TT_R", AngleAxes::u_n, AngleAxes::v_n, k_nalu_n_tt_r},
    {"N_TRT", AngleAxes::u_n, AngleAxes::v_n, k_nalu_n_trt},
};

}  // namespace

const Layout& entry() {
  static const Layout layout{
      .entry = nalu_entry("nalu_theta",
                          "as nalu over the angles themselves: resolves grazing directions, costs arc functions"),
      .tables = k_tables,
      .composition = k_three_textures,
      .terms = k_nalu_terms,
      .family = "nalu"};
  return layout;
}

}  // namespace cuticle::lut::nalu_theta
