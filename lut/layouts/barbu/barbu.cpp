#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::barbu {
namespace {

using Axes = SineAxes<false>;
/// Its shader maps this cosine as if it could be negative; the lower half of the rows is never read but by the filter.
constexpr Axis k_signed_cos_theta_d{AxisQuantity::cos_theta_d, -1, 1, false};
constexpr TableLayout k_tables[] = {{"M", Axes::u_m, Axes::v_m, k_nalu_m},
                                    {"N", Axes::u_n, k_signed_cos_theta_d, k_grey_n}};
constexpr std::string_view k_systems[] = {"N12"};

}  // namespace

const Layout& entry() {
  static const Layout layout{
      .entry = {.kind = registry::EntryKind::layout,
                .name = "barbu",
                .summary = "two textures addressed by value / 2 + 1 / 2: M and cos theta_d; N_R, N_TT, N_TRT without "
                           "colour; for marschner with variant=as_published",
                .source = "tcoppex/barbu, src/shaders/hair/marschner and 03_rendering/fs_render_hair.glsl at 38913e7",
                .systems = k_systems},
      .tables = k_tables,
      .composition = "S = (M_R N_R + M_TT N_TT + M_TRT N_TRT) / cos^2 theta_d",
      .terms = k_nalu_terms,
      .over_cos2_theta_d = true,
      .family = "barbu"};
  return layout;
}

}  // namespace cuticle::lut::barbu
