#include "lut/layouts/viewer_channels.h"

namespace cuticle::lut::yan_fur {
namespace {

/// What the medulla scattered and what is left after two inner reflections share one M.
constexpr Channel k_n_scattered[] = {
    {"N_residual.r", bsdf::Quantity::N, "TTs+TRTs+residual", 0, Texel::for_filter},
    {"N_residual.g", bsdf::Quantity::N, "TTs+TRTs+residual", 1, Texel::for_filter},
    {"N_residual.b", bsdf::Quantity::N, "TTs+TRTs+residual", 2, Texel::for_filter},
};
constexpr TableLayout k_tables[] = {
    {"M", AngleAxes::u_m, AngleAxes::v_m, k_smooth_m},
    {"N_TT_R", AngleAxes::u_n, k_viewer, k_smooth_n_tt_r},
    {"N_TRT", AngleAxes::u_n, k_viewer, k_smooth_n_trt},
    {"N_residual", AngleAxes::u_n, k_viewer, k_n_scattered},
};
constexpr std::string_view k_systems[] = {"N12"};

}  // namespace

const Layout& entry() {
  static const Layout layout{
      .entry = {.kind = registry::EntryKind::layout,
                .name = "yan_fur",
                .summary = "as chiang, with what a medulla scatters beside the residual, over phi too",
                .source = "Yan et al. 2017, An efficient and practical near and far field fur reflectance model",
                .systems = k_systems},
      .tables = k_tables,
      .composition = "S = M_R N_R + M_TT N_TT + M_TRT N_TRT + M_residual N_residual, N at abs(theta_o); N_residual "
                     "holds TTs and TRTs too",
      .terms = k_residual_terms,
      .family = "yan_fur"};
  return layout;
}

}  // namespace cuticle::lut::yan_fur
