#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::realengine {
namespace {

using Axes = SineAxes<false>;
constexpr TableLayout k_tables[] = {{"M", Axes::u_m, Axes::v_m, k_nalu_m}, {"N", Axes::u_n, Axes::v_n, k_grey_n}};
constexpr std::string_view k_systems[] = {"N12"};

}  // namespace

const Layout& entry() {
  static const Layout layout{
      .entry = {.kind = registry::EntryKind::layout,
                .name = "realengine",
                .summary =
                    "two textures addressed by value / 2 + 1 / 2 and by cos theta_d: M and cos theta_d; N_R, N_TT, "
                    "N_TRT without colour; for marschner with variant=as_published",
                .source =
                    "zhaijialong/RealEngine, source/renderer/marschner_hair_lut.cpp at 918a3c1, shaders/brdf.hlsli "
                    "at e9f2a69",
                .systems = k_systems},
      .tables = k_tables,
      .composition = "S = (M_R N_R + M_TT N_TT + M_TRT N_TRT) / cos^2 theta_d",
      .terms = k_nalu_terms,
      .over_cos2_theta_d = true,
      .family = "realengine"};
  return layout;
}

}  // namespace cuticle::lut::realengine
