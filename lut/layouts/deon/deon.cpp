#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::deon {
namespace {

constexpr Channel k_m[] = {
    {"M_R", bsdf::Quantity::M, "R", 0},
    {"M_TT", bsdf::Quantity::M, "TT", 0},
    {"M_TRT", bsdf::Quantity::M, "TRT", 0},
    {"M_residual", bsdf::Quantity::M, "residual", 0},
};
/// A rough fibre has no infinite peak: points.
constexpr Channel k_n_trt[] = {
    {"N_TRT.r", bsdf::Quantity::N, "TRT", 0},
    {"N_TRT.g", bsdf::Quantity::N, "TRT", 1},
    {"N_TRT.b", bsdf::Quantity::N, "TRT", 2},
};
constexpr TableLayout k_tables[] = {
    {"M", AngleAxes::u_m, AngleAxes::v_m, k_m},
    {"N_TT_R", AngleAxes::u_n, AngleAxes::v_n, k_nalu_n_tt_r},
    {"N_TRT", AngleAxes::u_n, AngleAxes::v_n, k_n_trt},
    {"N_residual", AngleAxes::v_n, k_no_axis, k_n_residual},
};
constexpr std::string_view k_systems[] = {"N12"};

}  // namespace

const Layout& entry() {
  static const Layout layout{
      .entry = {.kind = registry::EntryKind::layout,
                .name = "deon",
                .summary = "rough azimuthal tables over the angles: M of four lobes; N_TT and N_R; N_TRT; a row of "
                           "N_residual",
                .source = "d'Eon et al. 2011, An energy-conserving hair reflectance model",
                .systems = k_systems},
      .tables = k_tables,
      .composition =
          "S = M_R N_R + M_TT N_TT + M_TRT N_TRT + M_residual N_residual; with attenuation_angle=theta_o "
          "read N at abs(theta_o) in place of theta_d",
      .terms = k_residual_terms,
      .family = "deon"};
  return layout;
}

}  // namespace cuticle::lut::deon
