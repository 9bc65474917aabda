#include "lut/layouts/viewer_channels.h"

namespace cuticle::lut::chiang {
namespace {

constexpr TableLayout k_tables[] = {
    {"M", AngleAxes::u_m, AngleAxes::v_m, k_smooth_m},
    {"N_TT_R", AngleAxes::u_n, k_viewer, k_smooth_n_tt_r},
    {"N_TRT", AngleAxes::u_n, k_viewer, k_smooth_n_trt},
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
