#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::chiang {
namespace {

constexpr Axis k_viewer{AxisQuantity::abs_theta_o, 0, AngleAxes::right, true};
constexpr Channel k_m[] = {
    {"M_R", bsdf::Quantity::M, "R", 0, Texel::for_filter},
    {"M_TT", bsdf::Quantity::M, "TT", 0, Texel::for_filter},
    {"M_TRT", bsdf::Quantity::M, "TRT", 0, Texel::for_filter},
    {"M_residual", bsdf::Quantity::M, "residual", 0, Texel::for_filter},
};
constexpr Channel k_n_tt_r[] = {
    {"N_TT.r", bsdf::Quantity::N, "TT", 0, Texel::for_filter},
    {"N_TT.g", bsdf::Quantity::N, "TT", 1, Texel::for_filter},
    {"N_TT.b", bsdf::Quantity::N, "TT", 2, Texel::for_filter},
    {"N_R", bsdf::Quantity::N, "R", 0, Texel::for_filter},
};
constexpr Channel k_n_trt[] = {
    {"N_TRT.r", bsdf::Quantity::N, "TRT", 0, Texel::for_filter},
    {"N_TRT.g", bsdf::Quantity::N, "TRT", 1, Texel::for_filter},
    {"N_TRT.b", bsdf::Quantity::N, "TRT", 2, Texel::for_filter},
};
constexpr TableLayout k_tables[] = {
    {"M", AngleAxes::u_m, AngleAxes::v_m, k_m},
    {"N_TT_R", AngleAxes::u_n, k_viewer, k_n_tt_r},
    {"N_TRT", AngleAxes::u_n, k_viewer, k_n_trt},
    {"N_residual", k_viewer, k_no_axis, k_n_residual},
};
constexpr std::string_view k_systems[] = {"N12"};

}  // namespace

const Layout& entry() {
  static const Layout layout{
      .entry = {.kind = registry::EntryKind::layout,
                .name = "chiang",
                .summary = "as deon, with N over the viewer's inclination, where chiang and deon's far fields have it",
                .source = "Chiang et al. 2016, A practical and controllable hair and fur model for production path "
                          "tracing",
                .systems = k_systems},
      .tables = k_tables,
      .composition = "S = M_R N_R + M_TT N_TT + M_TRT N_TRT + M_residual N_residual, N at abs(theta_o)",
      .terms = k_residual_terms,
      .family = "chiang"};
  return layout;
}

}  // namespace cuticle::lut::chiang
